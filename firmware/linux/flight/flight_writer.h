// Writes the flight recorder to a file after each fault and on request. The loop adds its ticks; a
// thread beside it copies them to a file that `tactus replay` can replay.
//
// It uses static memory and no exceptions. It costs the loop one copy per tick.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>

#include "firmware/control/controller.h"
#include "firmware/linux/flight/fault_watch.h"
#include "firmware/linux/flight/flight_file.h"
#include "firmware/linux/flight/flight_recorder.h"
#include "firmware/linux/realtime/helper_thread.h"

namespace tactus::firmware {

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
  [[nodiscard]] const char* path() const { return file_.path(); }

 private:
  // A fault is written this long after it.
  static constexpr double kAfterFault_s = 0.2;

  // The thread's body.
  void run();
  // Writes a file with the ticks that there are, and prints its name.
  void write_out();

  // Guards the file against use_scene(); the loop never asks for it.
  std::mutex file_mutex_;
  FlightFile file_;
  FlightRecorder recorder_;
  FaultWatch faults_;
  HelperThread thread_;
  // False between leave_scene() and use_scene(): nothing is written then.
  std::atomic<bool> has_scene_{true};
  // True if a file is wanted.
  std::atomic<bool> wanted_{false};
  std::atomic<bool> stopping_{false};
  std::atomic<std::uint32_t> files_{0};
};

}  // namespace tactus::firmware
