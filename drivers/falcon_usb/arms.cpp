#include "drivers/falcon_usb/arms.h"

#include <cstddef>
#include <cstdlib>

namespace tactus::drivers {

namespace {

constexpr int kFalconCountsOfSlack = 4;
// The origin moves when the reference is found, so it is trusted after so many equal answers.
constexpr std::uint32_t kFalconHomedToBelieve = 8;

double arm_angle_rad(std::int16_t counts) {
  return kFalconZeroRad + counts * kFalconRadPerCount;
}

}  // namespace

void FalconArms::forget() {
  samples_.forget();
  homing_ = {};
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
    if (homing_.in_a_row == 0) {
      samples_.restart_velocity(arm);
    }
    samples_.take(arm, arm_angle_rad(counts[arm]), time_ns);
  }
}

void FalconArms::take_in_homing(bool all_homed, const Counts& counts, hal::TimeNs time_ns) {
  const bool is_steady = homing_.in_a_row == 0 || can_reach(counts, time_ns);
  homing_.in_a_row = all_homed && is_steady ? homing_.in_a_row + 1 : 0;
  homing_.is_done = homing_.in_a_row >= kFalconHomedToBelieve;
  homing_.is_reference_lost = homing_.is_reference_lost && !homing_.is_done;
  take(counts, time_ns);
}

}  // namespace tactus::drivers
