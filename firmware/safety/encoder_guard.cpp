#include "firmware/safety/encoder_guard.h"

#include <algorithm>
#include <cmath>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// A joint that would need longer than this for frozen_travel counts as standing still: its velocity
// is noise.
constexpr double kStandstill_s = 1.0;

}  // namespace

void EncoderGuard::configure(const ControllerConfig& config) {
  const SafetyConfig& safety = config.safety;
  joint_count_ = joint_count(config.mechanism);
  step_s_ = 1.0 / config.rate_hz;
  max_step_ = safety.max_joint_speed * step_s_;
  frozen_travel_ = safety.frozen_travel;
  blocked_ticks_to_fault_ =
      static_cast<std::uint32_t>(std::max(1.0, std::ceil(safety.blocked_s * config.rate_hz)));
  for (std::size_t i = 0; i < joint_count_; ++i) {
    joints_[i] = Joint{};
    joints_[i].blocked_step = safety.blocked_effort_share * config.joints[i].max_effort;
  }
  rest();
}

std::uint64_t EncoderGuard::check(const drivers::JointSample& sample, const JointEfforts& held,
                                  std::uint32_t missed_ticks) {
  const double elapsed_ticks = 1.0 + passed_ticks_ + missed_ticks;
  passed_ticks_ = 0;
  std::uint64_t faults = kNoFault;
  for (std::size_t i = 0; i < joint_count_; ++i) {
    if (!is_placed_) {
      joints_[i].position = sample.position[i];
      joints_[i].effort = held[i];
      joints_[i].travel = 0.0;
      joints_[i].blocked_ticks = 0;
    }
    faults |=
        check_joint(joints_[i], sample.position[i], sample.velocity[i], held[i], elapsed_ticks);
  }
  is_placed_ = true;
  return faults;
}

std::uint64_t EncoderGuard::check_joint(Joint& joint, double position, double velocity,
                                        double effort, double elapsed_ticks) const {
  if (position != joint.position) {
    const double step = std::abs(position - joint.position);
    joint.position = position;
    joint.effort = effort;
    joint.travel = 0.0;
    joint.blocked_ticks = 0;
    return step > max_step_ * elapsed_ticks ? kFaultEncoderJump : kNoFault;
  }
  const double speed = std::abs(velocity);
  joint.travel = speed * kStandstill_s > frozen_travel_ ? joint.travel + speed * step_s_ : 0.0;
  const bool is_blocked = std::abs(effort - joint.effort) > joint.blocked_step;
  joint.blocked_ticks = is_blocked ? std::min(joint.blocked_ticks + 1, blocked_ticks_to_fault_) : 0;
  return (joint.travel > frozen_travel_ ? kFaultEncoderFrozen : kNoFault) |
         (joint.blocked_ticks >= blocked_ticks_to_fault_ ? kFaultTorqueWithoutMotion : kNoFault);
}

}  // namespace tactus::firmware
