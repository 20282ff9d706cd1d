// The faults of an axis on GPIO, in words. Their numbers are stable; the log and the README use
// them.
#pragma once

#include <cstdint>

#include "drivers/axis.h"
#include "drivers/gpio_axis/quadrature.h"
#include "hal/error.h"

namespace tactus::drivers {

enum class GpioAxisTrouble : std::uint8_t {
  none = 0,
  edges_lost = 1,  // 1 to 8: EncoderFault
  illegal_transition = 2,
  levels_disagree = 3,
  index_moved = 4,
  index_missing = 5,
  jump = 6,
  noise = 7,
  silent = 8,
  bridge_fault = 20,
  limits_contradict = 21,
  emergency_stop = 30,
  safety_edges_lost = 31,
  lines_gone = 40,
  lines_fail = 41,
  pwm_gone = 42,
  pwm_fails = 43,
  counter_gone = 44,
  counter_fails = 45,
  not_configured = 50,
};

constexpr GpioAxisTrouble trouble_of(EncoderFault fault) {
  return static_cast<GpioAxisTrouble>(fault);
}

// Returns the DeviceStatus bits of the fault.
std::uint32_t status_of(GpioAxisTrouble trouble);

// Returns the words for the log and the operator. `code` is the number above.
Trouble describe(GpioAxisTrouble trouble);

}  // namespace tactus::drivers
