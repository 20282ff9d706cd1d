#include "firmware/safety/effort_guard.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// Weaker efforts and slower motions do not count.
constexpr double kLeast_N = 0.8;
constexpr double kLeast_m_per_s = 0.01;
// The mass M of a device's handle and a hand.
constexpr double kMass_kg = 0.3;
// The share of the effort by which the mass must be accelerated.
constexpr double kShare = 0.3;
// The growth that is a fault: effort and speed have become e^1.3 = 3.7 times as large.
constexpr double kGrowth = 1.3;
// The share of the growth that is left after a tick without growth.
constexpr double kForgotten = 0.8;
// The time constants of the low-passes, and the time for which a mismatch must last.
constexpr double kMotionSmoothing_s = 0.004;

// The tolerance: a quarter of the commanded effort and a tenth of the joint's largest.
constexpr double kTolerance = 0.25;
constexpr double kLeastShare = 0.1;
constexpr double kEffortSmoothing_s = 0.02;
// A drive's own filter and the time in which it measures.
constexpr double kDriveDelay_s = 0.005;
// A command reaches the drive within the tick, and the measurement comes with the next sample.
constexpr double kTicksOnTheBus = 2.0;
constexpr double kMismatch_s = 0.01;

// A joint whose unit moves the tool by less than this, m, does not count.
constexpr double kLeastLever = 1e-6;

// Returns the share by which a low-pass of that time constant follows in a step (backward Euler).
double share_of_step(double step_s, double smoothing_s) {
  return step_s / (step_s + smoothing_s);
}

}  // namespace

void EffortGuard::configure(const ControllerConfig& config) {
  joint_count_ = joint_count(config.mechanism);
  step_s_ = 1.0 / config.rate_hz;
  motion_share_ = share_of_step(step_s_, kMotionSmoothing_s);
  effort_share_ = share_of_step(step_s_, kEffortSmoothing_s);
  wrong_ticks_to_fault_ =
      static_cast<std::uint32_t>(std::max(1.0, std::ceil(kMismatch_s * config.rate_hz)));
  late_ticks_ = static_cast<std::uint32_t>(
      kTicksOnTheBus + std::ceil((kDriveDelay_s + config.safety.device_delay_s) * config.rate_hz));
  for (std::size_t i = 0; i < kJointCount; ++i) {
    joints_[i].largest = config.joints[i].max_effort;
  }
  rest();
}

void EffortGuard::rest() {
  for (Joint& joint : joints_) {
    joint = Joint{.largest = joint.largest};
  }
  span_ticks_ = 0;
}

EffortFinding EffortGuard::check(const drivers::JointSample& sample, const Pose& pose,
                                 const JointEfforts& held) {
  EffortFinding found;
  pass(held);
  for (std::size_t i = 0; i < joint_count_; ++i) {
    std::uint64_t faults = kNoFault;
    const double lever = pose.jacobian_D.col(static_cast<Eigen::Index>(i)).norm();
    if (lever > kLeastLever &&
        is_driven_against(joints_[i], held[i] / lever, sample.velocity[i] * lever)) {
      faults |= kFaultMotorReversed;
    }
    const bool is_new = (sample.effort_is_new & sample.effort_known & 1U << i) != 0;
    if (is_new && is_mismatched(joints_[i], held[i], sample.effort[i])) {
      faults |= kFaultEffortMismatch;
    }
    if (faults != kNoFault && found.joint == 0) {
      found.joint = static_cast<std::uint32_t>(i + 1);
    }
    found.faults |= faults;
  }
  return found;
}

bool EffortGuard::is_driven_against(Joint& joint, double force_N, double speed_m_per_s) const {
  const double force_step = motion_share_ * (force_N - joint.force_N);
  const double speed_step = motion_share_ * (speed_m_per_s - joint.speed_m_per_s);
  joint.force_N += force_step;
  joint.speed_m_per_s += speed_step;
  // The signs are turned so that the force is positive and the speed is positive against it.
  const double way = joint.force_N < 0.0 ? -1.0 : 1.0;
  const double force = way * joint.force_N;
  const double speed = -way * joint.speed_m_per_s;
  const double force_rise = way * force_step;
  const double speed_rise = -way * speed_step;
  const bool is_fed = force > kLeast_N && speed > kLeast_m_per_s && force_rise > 0.0 &&
                      speed_rise > 0.0 && kMass_kg * speed_rise > kShare * force * step_s_;
  joint.growth = is_fed ? joint.growth + std::min(force_rise / force, speed_rise / speed)
                        : kForgotten * joint.growth;
  return joint.growth > kGrowth;
}

void EffortGuard::pass(const JointEfforts& held) {
  const bool begins_span = span_ticks_ == late_ticks_;
  span_ticks_ = begins_span ? 1 : span_ticks_ + 1;
  for (std::size_t i = 0; i < joint_count_; ++i) {
    Joint& joint = joints_[i];
    if (begins_span) {
      joint.held_before = joint.held_now;
      joint.held_now = {.least = held[i], .most = held[i]};
    }
    joint.held_now.least = std::min(joint.held_now.least, held[i]);
    joint.held_now.most = std::max(joint.held_now.most, held[i]);
    joint.commanded += effort_share_ * (held[i] - joint.commanded);
    ++joint.unmeasured_ticks;
  }
}

// A measurement that is not finite counts as the reverse of the command.
bool EffortGuard::is_mismatched(Joint& joint, double held, double measured) const {
  const double finite = std::isfinite(measured) ? measured : -held;
  const double nearest = std::clamp(finite, std::min(joint.held_now.least, joint.held_before.least),
                                    std::max(joint.held_now.most, joint.held_before.most));
  const std::uint32_t ticks = std::exchange(joint.unmeasured_ticks, 0);
  joint.distance +=
      share_of_step(ticks * step_s_, kEffortSmoothing_s) * (finite - nearest - joint.distance);
  const bool is_wrong = std::abs(joint.distance) >
                        kTolerance * std::abs(joint.commanded) + kLeastShare * joint.largest;
  if (!is_wrong) {
    joint.wrong_ticks = 0;
    return false;
  }
  joint.wrong_ticks += joint.wrong_ticks == 0 ? 1 : ticks;
  return joint.wrong_ticks > wrong_ticks_to_fault_;
}

}  // namespace tactus::firmware
