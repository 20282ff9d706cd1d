#include "firmware/safety/motion_guard.h"

#include <algorithm>

#include "firmware/safety/faults.h"
#include "firmware/safety/force_limiter.h"

namespace tactus::firmware {

void MotionGuard::configure(const ControllerConfig& config) {
  step_s_ = 1.0 / config.rate_hz;
  max_speed_m_per_s_ = config.safety.max_tool_speed_m_per_s;
  runaway_speed_m_per_s_ = config.safety.runaway_speed_m_per_s;
  runaway_travel_m_ = config.safety.runaway_travel_m;
  rest();
}

std::uint64_t MotionGuard::check(const Vec3& v_W, const Vec3& held_W) {
  const double speed = length_of(v_W);
  if (speed > runaway_speed_m_per_s_ && held_W.dot(v_W) <= 0.0) {
    // The bound keeps the number finite while the fault lasts.
    runaway_m_ = std::min(runaway_m_ + speed * step_s_, 2.0 * runaway_travel_m_);
  } else {
    runaway_m_ = 0.0;
  }
  return (speed > max_speed_m_per_s_ ? kFaultOverspeed : kNoFault) |
         (runaway_m_ > runaway_travel_m_ ? kFaultMotionWithoutTorque : kNoFault);
}

SlowedForce MotionGuard::slow(const Vec3& force_W, const Vec3& v_W) const {
  const double speed = length_of(v_W);
  const double soft = 0.5 * max_speed_m_per_s_;
  if (speed <= soft) {
    return {.force_W = force_W};
  }
  const Vec3 along = v_W / speed;
  const double push_N = force_W.dot(along);
  if (push_N <= 0.0) {
    return {.force_W = force_W};
  }
  const double taken = std::min(1.0, (speed - soft) / soft);
  return {.force_W = force_W - taken * push_N * along, .limits = kLimitSpeed};
}

}  // namespace tactus::firmware
