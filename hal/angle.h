// Converts angles between radians, in which the project computes, and degrees, in which files,
// people and some devices have them.
#pragma once

#include <numbers>

namespace tactus::hal {

constexpr double degrees_of(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

constexpr double radians_of(double angle_deg) {
  return angle_deg * std::numbers::pi / 180.0;
}

}  // namespace tactus::hal
