// Holds QEMU to the time of this machine: it lets a board's second take a second, unless QEMU is
// slower by itself. One thread.
//
// QEMU's own pace (sleep=on) lets the board's time jump as far as this machine was late, which the
// board's watchdog takes for a hung tick. Without one a board that has little to do runs twenty
// times as fast as its time, and takes a host that is there ten times a second for lost. So the
// board's time is read over QEMU's monitor, and QEMU is paused while it is ahead.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "hal/linux/system.h"

namespace tactus::host {

class EmulatorPace {
 public:
  EmulatorPace() = default;
  // `monitor` is our end of QEMU's human monitor, which does not wait.
  explicit EmulatorPace(hal::FileDescriptor monitor) : monitor_(std::move(monitor)) {}

  // Returns the descriptor to wait for, and the time at which turn() is to be called without it.
  [[nodiscard]] int descriptor() const { return monitor_.get(); }
  [[nodiscard]] hal::TimeNs due_ns() const { return has_prompt_ ? due_ns_ : kNothingIsDue_ns; }

  // Takes what the monitor has said, and asks or orders what is due.
  void turn(hal::TimeNs now_ns);

 private:
  static constexpr hal::TimeNs kNothingIsDue_ns = std::numeric_limits<hal::TimeNs>::max();

  void say(std::string_view order);
  // Takes the answer to the question for the board's time.
  void take_time(std::uint32_t counter, hal::TimeNs now_ns);

  hal::FileDescriptor monitor_;
  std::string heard_;
  // False while the monitor is busy, as at the beginning.
  bool has_prompt_ = false;
  bool is_paused_ = false;
  hal::TimeNs due_ns_ = 0;
  // The board's counter at the last question, and its time since the first one.
  std::optional<std::uint32_t> counter_;
  hal::TimeNs board_ns_ = 0;
  // The time of this machine at which the board's time was 0.
  hal::TimeNs begin_ns_ = 0;
};

// Returns the number that the monitor's answer to a look at one word of memory ends with.
std::optional<std::uint32_t> word_of_monitor(std::string_view answer);

}  // namespace tactus::host
