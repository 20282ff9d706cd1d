// What is left of a torque command on its way into a frame.
#pragma once

#include <algorithm>
#include <cmath>

#include "drivers/axis.h"

namespace tactus::drivers {

// Zero without `enable` or if not a number; never beyond the limit, also not by the rounding to
// single precision.
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
