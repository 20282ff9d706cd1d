// Writes the flight recorder to a file after each fault and on request. The loop adds its ticks; a
// thread beside it copies them to a file that `tactus replay` can replay.
//
// It uses static memory and no exceptions. It costs the loop one copy per tick.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>

#include "firmware/control/controller.h"
#include "firmware/linux/flight/fault_watch.h"
#include "firmware/linux/flight/flight_file.h"
#include "firmware/linux/flight/flight_recorder.h"
#include "firmware/linux/flight/flight_ticks.h"
#include "firmware/linux/realtime/helper_thread.h"
#include "rendering/limits.h"

namespace tactus::firmware {

// The ticks and files of a device beyond the controller's first one. It belongs into static
// storage.
struct FlightCompanion {
  // The loop's thread adds the device's ticks, each before the first device's tick of that number.
  FlightTicks ticks;
  FlightFile file;
};

// The recorder with its writer. A controller of several devices has one, which writes a file for
// each device. It belongs into static storage.
class FlightWriter {
 public:
  FlightWriter() = default;
  FlightWriter(const FlightWriter&) = delete;
  FlightWriter& operator=(const FlightWriter&) = delete;
  ~FlightWriter() { stop(); }

  // Starts the thread. Call before the loop begins. Returns 0 or errno.
  int start(const FlightPlan& plan);

  // Writes a file of this device beside each file of the first one. Call before start(), once for
  // each device beyond the first, in their order.
  void accompany(FlightCompanion& companion, const FlightPlan& plan);

  // Gives the recorder `room` for the controller's states, FlightRecorder::kStates times
  // kMaxCheckpointBytes for each device. It must outlive the writer. Without it there is room for
  // one device. Call before start().
  void use_room(std::span<std::byte> room) { recorder_.use_room(room); }

  // Adds a tick of the first device. A fault of any device is written kAfterFault_s later, so that
  // the file holds the ticks after it. Call from the loop's thread after each tick.
  void add(const RecordedTick& tick, Controller& controller);
  // Drops all ticks, because the controller has another scene from the next tick on. Nothing is
  // written until use_scene() has given the image. Call from the loop's thread.
  void leave_scene();
  // Sets the image of the new scene. It must outlive the writer or the next use_scene(). Waits
  // while a file is being written; when it returns, the previous image is no longer used. Call from
  // another thread than the loop's.
  void use_scene(std::span<const std::byte> image);

  // Asks for a file with the ticks that there are. Any thread, or a signal handler.
  void ask() { wanted_.store(1, std::memory_order_release); }

  // Writes a fault that is not written yet and ends the thread. Call after the loop's last tick.
  void stop();

  // Returns the number of files written so far. Any thread.
  [[nodiscard]] std::uint32_t files() const { return files_.load(std::memory_order_acquire); }
  // Returns the path of the last file. Call after stop().
  [[nodiscard]] const char* path() const { return file_.path(); }

 private:
  // A fault is written this long after it.
  static constexpr double kAfterFault_s = 0.2;

  // The thread's body.
  void run();
  // Writes a file for each device with the ticks that there are, and prints the names.
  void write_out();
  // Writes the files of a window. Returns the number of ticks that each of them has, 0 if the loop
  // has overwritten one, or nothing after it has printed why a file could not be written.
  std::optional<std::uint64_t> write_files(const FlightWindow& window);
  [[nodiscard]] std::span<FlightCompanion* const> companions() const {
    return std::span(companions_).first(companion_count_);
  }
  // Returns true if the fault of a device is not written yet.
  [[nodiscard]] bool is_fault_waiting() const;

  // Guards the file against use_scene(); the loop never asks for it.
  std::mutex file_mutex_;
  FlightFile file_;
  FlightRecorder recorder_;
  // One more than there may be, because an array has at least one.
  std::array<FlightCompanion*, rendering::kMaxTools> companions_{};
  std::size_t companion_count_ = 0;
  // The watch over each device.
  std::array<FaultWatch, rendering::kMaxTools> faults_;
  HelperThread thread_;
  // False between leave_scene() and use_scene(): nothing is written then.
  std::atomic<bool> has_scene_{true};
  // 1 if a file is wanted. A word: RISC-V has no atomic bytes.
  std::atomic<std::uint32_t> wanted_{0};
  std::atomic<bool> stopping_{false};
  std::atomic<std::uint32_t> files_{0};
};

}  // namespace tactus::firmware
