#include "host_tools/emulators/falcon_homing.h"

#include <cmath>

#include "hal/angle.h"

namespace tactus::host {

namespace {

// An arm finds its reference when it has been beyond the first angle and comes back below the
// second.
constexpr double kPulledOut_rad = 1.0;
constexpr double kPushedIn_rad = 0.7;
// The encoder's disc has 320 slots, read four times each; the capstan has 14.25 mm, the arm's arc
// 110 mm. The firmware's zero is at 35 degrees.
constexpr double kArmDegreesPerCount = 360.0 * 14.25 / (320.0 * 4.0 * 110.0);
constexpr double kArmDegreesAtZero = 35.0;

}  // namespace

void FalconHoming::watch(std::span<const EmulatedShaft, kArms> arms, bool is_asked) {
  if (!origin_known_) {
    for (std::size_t arm = 0; arm < kArms; ++arm) {
      origin_rad_[arm] = arms[arm].position_rad;
    }
    origin_known_ = true;
  }
  for (std::size_t arm = 0; is_asked && arm < kArms; ++arm) {
    was_out_[arm] = was_out_[arm] || arms[arm].position_rad > kPulledOut_rad;
    if (was_out_[arm] && arms[arm].position_rad < kPushedIn_rad) {
      homed_ = static_cast<std::uint8_t>(homed_ | (1U << arm));
    }
  }
}

void FalconHoming::start_again() {
  homed_ = 0;
  was_out_ = {};
}

void FalconHoming::lose_power() {
  start_again();
  origin_known_ = false;
}

int FalconHoming::count(std::size_t arm, double position_rad) const {
  const bool is_homed = ((unsigned{homed_} >> arm) & 1U) != 0;
  const double counted_deg = is_homed ? hal::degrees_of(position_rad) - kArmDegreesAtZero
                                      : hal::degrees_of(position_rad - origin_rad_[arm]);
  return static_cast<int>(std::lround(counted_deg / kArmDegreesPerCount));
}

}  // namespace tactus::host
