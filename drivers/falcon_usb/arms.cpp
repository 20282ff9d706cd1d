#include "drivers/falcon_usb/arms.h"

#include <cstddef>
#include <cstdlib>

namespace tactus::drivers {

namespace {

constexpr int kFalconCountsOfSlack = 4;

double arm_angle_rad(std::int16_t counts) {
  return kFalconZeroRad + counts * kFalconRadPerCount;
}

}  // namespace

void FalconArms::restart_velocities() {
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    samples_.restart_velocity(arm);
  }
}

bool FalconArms::can_reach(const Counts& counts, hal::TimeNs time_ns) const {
  const Counts& from = last_.before(time_ns);
  const double reach_rad = last_.reach_rad(fastest_rad_per_s_, time_ns);
  const int reach = kFalconCountsOfSlack + static_cast<int>(reach_rad / kFalconRadPerCount);
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    if (std::abs(int{counts[arm]} - int{from[arm]}) > reach) {
      return false;
    }
  }
  return true;
}

void FalconArms::take(const Counts& counts, hal::TimeNs time_ns) {
  last_.take(counts, time_ns);
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    samples_.take(arm, arm_angle_rad(counts[arm]), time_ns);
  }
}

}  // namespace tactus::drivers
