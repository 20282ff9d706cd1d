// Clamps the torque of a command for a frame.
#pragma once

#include <algorithm>
#include <cmath>

#include "drivers/axis.h"

namespace tactus::drivers {

// Returns the torque to send, N m in single precision. It is zero without `enable` or for NaN, and
// never beyond the limit, even after rounding.
inline float clamped_torque_Nm(const AxisCommand& command, double max_torque_Nm) {
  if (!command.enable || std::isnan(command.torque_Nm)) {
    return 0.0F;
  }
  const auto rounded =
      static_cast<float>(std::clamp(command.torque_Nm, -max_torque_Nm, max_torque_Nm));
  return std::abs(static_cast<double>(rounded)) > max_torque_Nm ? std::nextafter(rounded, 0.0F)
                                                                : rounded;
}

}  // namespace tactus::drivers
