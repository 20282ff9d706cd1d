// A thread that reports on the loop: it prints every change of a device's mode to stderr, and
// notifies the service manager that the loop is alive. The loop stores some numbers and never waits
// for it.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/control/mode.h"
#include "firmware/linux/realtime/helper_thread.h"
#include "firmware/linux/realtime/service_notice.h"
#include "firmware/linux/tactusd/mode_log.h"
#include "hal/clock.h"
#include "rendering/limits.h"

namespace tactus::firmware {

// The reporter of one loop, which never waits for it.
class Supervisor {
 public:
  Supervisor() = default;
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;
  ~Supervisor() { stop(); }

  // Starts the thread. It sends READY=1 with the first tick, and WATCHDOG=1 twice per watchdog
  // period while ticks come. `notice` must outlive this. Messages name the device if there are
  // several. Returns 0 or errno.
  int start(const ServiceNotice& notice, std::size_t devices = 1);

  // Notes the mode of each device after a tick. Call from the loop once per tick; real time. If the
  // thread cannot run for more than ModeLog::kModesKept changes, the oldest are not printed.
  void note(std::span<const Mode> modes);

  // Prints the remaining changes, sends STOPPING=1 and ends the thread.
  void stop();

 private:
  // The thread's body.
  void run();
  // Prints the changes since the last call.
  void print_modes();
  // Tells the manager that ticks have come since the last call.
  void notify_manager(hal::TimeNs now_ns);

  const ServiceNotice* notice_ = nullptr;
  std::optional<hal::TimeNs> watchdog_period_ns_;
  HelperThread thread_;
  std::atomic<bool> stopping_{false};

  std::size_t devices_ = 1;
  // The loop writes these: the changes of each device's mode, and the number of ticks.
  std::array<ModeLog, rendering::kMaxTools> modes_;
  std::atomic<std::uint64_t> ticks_{0};

  // Only the thread uses these: the ticks seen, and the time of the next WATCHDOG=1.
  std::uint64_t ticks_seen_ = 0;
  hal::TimeNs next_watchdog_ns_ = 0;
};

}  // namespace tactus::firmware
