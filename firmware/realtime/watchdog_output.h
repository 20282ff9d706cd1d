// A GPIO line that toggles with every healthy tick. An external circuit takes the motors' power
// away when the line stops toggling, whatever has happened to this program.
#pragma once

#include <cstdint>

#include "hal/gpio_lines.h"

namespace tactus::firmware {

class WatchdogOutput {
 public:
  // Requests the line and sets it inactive. `lines` must outlive this. Errors are those of
  // GpioLines::request. Not real time.
  hal::Result<void> open(hal::GpioLines& lines, const hal::GpioLineConfig& line);

  // Real time: one system call where a line is held. Turns the line over in a healthy tick and
  // leaves it alone in any other. False if the line cannot be set.
  bool tick(bool healthy);

  // Ticks in which the line could not be set.
  [[nodiscard]] std::uint64_t failed() const { return failed_; }

 private:
  hal::GpioLines* lines_ = nullptr;
  bool active_ = false;
  std::uint64_t failed_ = 0;
};

}  // namespace tactus::firmware
