// A line that changes with every healthy tick: a circuit outside takes the motors' power away when
// it stops changing, whatever has become of this program.
#pragma once

#include <cstdint>

#include "hal/gpio_lines.h"

namespace tactus::firmware {

class WatchdogOutput {
 public:
  // Holds the line, inactive at first. `lines` must outlive this. Not real time. Errors are those
  // of GpioLines::request.
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
