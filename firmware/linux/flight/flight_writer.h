// Writes the flight recorder to a file after each fault and on request. The loop adds its ticks; a
// thread beside it copies them to a file that `tactus replay` can replay.
//
// It uses static memory and no exceptions. It costs the loop one copy per tick.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>

#include "firmware/control/controller.h"
#include "firmware/linux/flight/flight_recorder.h"
#include "firmware/linux/realtime/helper_thread.h"
#include "firmware/linux/telemetry/mcap_writer.h"
#include "firmware/linux/telemetry/run_recorder.h"

namespace tactus::firmware {

// The content of the files beside the ticks. All that it points to must outlive the writer, except
// the scene's image (see use_scene()). At most AttachmentList::kMost - 1 images and 22 metadata
// entries are kept.
struct FlightPlan {
  // An existing folder for the files.
  const char* folder = ".";
  // The number of ticks per second.
  double rate_hz = 1000.0;
  // The metadata of the run.
  RunDescription run;
  // The images, such as the device's and the scene's.
  std::span<const Attachment> images;
};

// The recorder with its writer. It belongs into static storage.
class FlightWriter {
 public:
  FlightWriter() = default;
  FlightWriter(const FlightWriter&) = delete;
  FlightWriter& operator=(const FlightWriter&) = delete;
  ~FlightWriter() { stop(); }

  // Starts the thread. Call before the loop begins. Returns 0 or errno.
  int start(const FlightPlan& plan);

  // Adds a tick. A fault is written kAfterFault_s later, so that the file holds the ticks after it.
  // Call from the loop's thread after each tick.
  void add(const RecordedTick& tick, Controller& controller);
  // Drops all ticks, because the controller has another scene from the next tick on. Nothing is
  // written until use_scene() has given the image. Call from the loop's thread.
  void leave_scene() {
    recorder_.forget();
    has_scene_.store(false, std::memory_order_release);
  }
  // Sets the image of the new scene. It must outlive the writer or the next use_scene(). Waits
  // while a file is being written; when it returns, the previous image is no longer used. Call from
  // another thread than the loop's.
  void use_scene(std::span<const std::byte> image);

  // Asks for a file with the ticks that there are. Any thread, or a signal handler.
  void ask() { wanted_.store(true, std::memory_order_release); }

  // Writes a fault that is not written yet and ends the thread. Call after the loop's last tick.
  void stop();

  // Returns the number of files written so far. Any thread.
  [[nodiscard]] std::uint32_t files() const { return files_.load(std::memory_order_acquire); }
  // Returns the path of the last file. Call after stop().
  [[nodiscard]] const char* path() const { return path_.data(); }

 private:
  // A fault is written this long after it.
  static constexpr double kAfterFault_s = 0.2;
  static constexpr std::size_t kMaxInfo = 24;

  // The thread's body.
  void run();
  // Writes a file with the ticks that there are, and prints its name.
  void write_out();
  // Copies the lists of the plan, which use_scene() changes.
  void copy_plan();
  // Sets path_ to a name with the time and the tick.
  void name_file(std::uint64_t tick);
  int write_file(const FlightWindow& window, std::uint64_t& first, std::uint64_t& end);

  FlightPlan plan_;
  // Guards images and description against use_scene(); the loop never asks for it.
  std::mutex plan_mutex_;
  AttachmentList images_;
  std::array<MetadataEntry, kMaxInfo> info_{};
  std::size_t info_count_ = 0;
  std::array<char, 16> scene_checksum_{};
  FlightRecorder recorder_;
  McapWriter file_;
  HelperThread thread_;
  std::array<char, 512> path_{};

  // Loop only: the mode of the last tick.
  Mode mode_ = Mode::init;
  // Loop only: the number of ticks until a fault is written.
  std::uint64_t ticks_to_wait_ = 0;
  // False between leave_scene() and use_scene(): nothing is written then.
  std::atomic<bool> has_scene_{true};
  // True while a fault waits to be written.
  std::atomic<bool> waiting_{false};
  // True if a file is wanted.
  std::atomic<bool> wanted_{false};
  std::atomic<bool> stopping_{false};
  std::atomic<std::uint32_t> files_{0};
};

}  // namespace tactus::firmware
