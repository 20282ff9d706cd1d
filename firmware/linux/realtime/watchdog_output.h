// A GPIO line that toggles with every healthy tick. An external circuit takes the motors' power
// away when the line stops toggling, whatever has happened to this program. One thread.
#pragma once

#include <cstdint>

#include "hal/gpio_lines.h"

namespace tactus::firmware {

// The line; without open() it does nothing.
class WatchdogOutput {
 public:
  // Requests the line and sets it inactive. `lines` must outlive this. Errors are those of
  // GpioLines::request. Not real time.
  hal::Result<void> open(hal::GpioLines& lines, const hal::GpioLineConfig& line);

  // Toggles the line in a healthy tick and leaves it unchanged in any other. Returns false if the
  // line cannot be set; true without a line. Real time: one system call.
  bool tick(bool healthy);

  // Returns the number of ticks in which the line could not be set.
  [[nodiscard]] std::uint64_t failed() const { return failed_; }

 private:
  hal::GpioLines* lines_ = nullptr;
  // The level of the line after the last tick.
  bool active_ = false;
  std::uint64_t failed_ = 0;
};

}  // namespace tactus::firmware
