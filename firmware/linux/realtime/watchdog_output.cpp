#include "firmware/linux/realtime/watchdog_output.h"

#include <span>

namespace tactus::firmware {

hal::Result<void> WatchdogOutput::open(hal::GpioLines& lines, const hal::GpioLineConfig& line) {
  const auto held = lines.request({.lines = std::span(&line, 1), .consumer = "tactus watchdog"});
  if (held) {
    lines_ = &lines;
    active_ = line.initial_active;
  }
  return held;
}

bool WatchdogOutput::tick(bool healthy) {
  if (lines_ == nullptr || !healthy) {
    return true;
  }
  if (!lines_->set(1, active_ ? 0 : 1)) {
    ++failed_;
    return false;
  }
  active_ = !active_;
  return true;
}

}  // namespace tactus::firmware
