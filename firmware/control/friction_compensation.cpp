#include "firmware/control/friction_compensation.h"

#include <algorithm>
#include <cmath>

#include "firmware/safety/force_limiter.h"

namespace tactus::firmware {

void FrictionCompensation::configure(const ControllerConfig& config) {
  step_s_ = 1.0 / config.rate_hz;
  limits_ = config.joints;
  is_on_ = false;
  joint_count_ = joint_count(config.mechanism);
  joints_.fill({});
  for (std::size_t i = 0; i < joint_count_; ++i) {
    const JointFriction& joint = config.friction[i];
    const double level = joint.compensated_share * joint.model.coulomb;
    joints_[i] = Joint{
        .bristle = {.kind = rendering::FrictionKind::dahl,
                    .coulomb = level,
                    // Dahl's bristle yields at `coulomb` after about `coulomb` / `stiffness`: this
                    // makes that length l.
                    .stiffness_N_per_m = level > 0.0 ? level / presliding_length(joint) : 0.0},
        .memory = {},
        .viscous = joint.compensated_share * joint.model.viscous_s_per_m};
    is_on_ = is_on_ || joint.compensated_share > 0.0;
  }
  retune(config);
  rest();
}

void FrictionCompensation::retune(const ControllerConfig& config) {
  gain_per_tick_ = gain_per_tick(config.safety.soft_start_s, config.rate_hz);
  velocity_filter_.retune(config.velocity_cutoff_hz, config.rate_hz);
}

void FrictionCompensation::rest() {
  for (Joint& joint : joints_) {
    joint.memory = {};
  }
  velocity_filter_.reset();
  gain_ = 0.0;
  is_placed_ = false;
}

FrictionPush FrictionCompensation::push(const Vec3& position, const Vec3& velocity,
                                        const PushRoom& room) {
  const Vec3 speed = velocity_filter_.filter(velocity);
  FrictionPush push;
  for (std::size_t i = 0; i < joint_count_; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    Joint& joint = joints_[i];
    const double moved = is_placed_ ? position[axis] - last_position_[axis] : 0.0;
    const double bristle = rendering::update_friction(joint.bristle, joint.memory, moved,
                                                      rendering::kNoNormalForce_N, step_s_)
                               .force_N;
    push.effort[axis] = gain_ * (bristle + joint.viscous * speed[axis]);
  }
  last_position_ = position;
  is_placed_ = true;
  gain_ = std::min(1.0, gain_ + gain_per_tick_);
  const double share = share_that_fits(push.effort, room);
  push.effort *= share;
  push.is_held_back = share < 1.0;
  return push;
}

// One factor for all joints keeps the direction of the push at the tool.
double FrictionCompensation::share_that_fits(const Vec3& effort, const PushRoom& room) const {
  double share = 1.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const double left = std::max(0.0, limits_[i].max_effort - std::abs(room.effort[axis]));
    const double size = std::abs(effort[axis]);
    if (share * size > left) {
      share = left / size;
    }
  }
  const double force_N = length_of(tool_force(room.pose, effort, joint_count_));
  const bool fits = share * force_N <= room.force_N;
  if (!fits) {
    share = room.force_N / force_N;
  }
  return share;
}

}  // namespace tactus::firmware
