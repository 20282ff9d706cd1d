#include "firmware/control/gravity_compensation.h"

#include <algorithm>
#include <cmath>

#include "firmware/safety/force_limiter.h"

namespace tactus::firmware {

void GravityCompensation::configure(const ControllerConfig& config) {
  is_on_ = has_weight(config.mechanism) && config.gravity_D != Vec3::Zero();
  retune(config);
  gravity_D_ = config.gravity_D;
  limits_ = config.joints;
  rest();
}

void GravityCompensation::retune(const ControllerConfig& config) {
  gain_per_tick_ = gain_per_tick(config.safety.soft_start_s, config.rate_hz);
}

GravityHold GravityCompensation::hold(const Mechanism& mechanism, const Vec3& joints,
                                      const Pose& pose) {
  GravityHold hold{.effort = gain_ * mechanism.gravity_effort(joints, pose, gravity_D_)};
  // The gain of this tick was used above: the first active tick gives zero.
  gain_ = std::min(1.0, gain_ + gain_per_tick_);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    double& effort = hold.effort[static_cast<Eigen::Index>(i)];
    const double limit = limits_[i].max_effort;
    hold.is_held_back = hold.is_held_back || std::abs(effort) > limit;
    effort = std::clamp(effort, -limit, limit);
  }
  return hold;
}

}  // namespace tactus::firmware
