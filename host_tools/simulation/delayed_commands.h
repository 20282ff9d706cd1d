// The way of a command from the controller to the motors of the simulated device, which takes whole
// ticks.
#pragma once

#include <array>
#include <cstddef>

#include "drivers/device.h"

namespace tactus::host {

// The longest delay of a command, ticks.
inline constexpr std::size_t kMaxCommandDelay = 8;

// The commands on their way.
class DelayedCommands {
 public:
  // The delay is at most kMaxCommandDelay.
  explicit DelayedCommands(std::size_t delay_ticks) : delay_ticks_(delay_ticks) {}

  // Takes the command of this tick. A tick without a call repeats the command before.
  void write(const drivers::JointCommand& command) { written_ = command; }

  // Ends the tick and returns the command that drives the motors until the next one. It is the
  // empty command while none has arrived.
  const drivers::JointCommand& advance() {
    ring_[now_] = written_;
    const std::size_t arrived = (now_ + ring_.size() - delay_ticks_) % ring_.size();
    now_ = (now_ + 1) % ring_.size();
    return ring_[arrived];
  }

 private:
  std::size_t delay_ticks_;
  drivers::JointCommand written_;
  // The commands of the last ticks; `now_` is the place of this tick's.
  std::array<drivers::JointCommand, kMaxCommandDelay + 1> ring_{};
  std::size_t now_ = 0;
};

}  // namespace tactus::host
