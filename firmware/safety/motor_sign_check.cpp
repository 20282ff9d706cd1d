#include "firmware/safety/motor_sign_check.h"

#include <algorithm>
#include <cmath>

#include "firmware/kinematics/mobility.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// The first pulse, as a share of the largest push.
constexpr double kFirstShare = 0.6;
// The ratio of the pulses before and after a joint was unclear.
constexpr double kStronger = 1.3;
// The largest pulse, as a share of the joint's largest effort.
constexpr double kMostOfEffort = 0.5;
// The numbers of pulses in a row that decide.
constexpr std::uint32_t kRight = 2;
constexpr std::uint32_t kWrong = 3;
// After this many unclear pulses in a row it is another joint's turn.
constexpr std::uint32_t kUnclear = 3;
// After this many there is a pause before the next pulse.
constexpr std::uint32_t kMostUnclear = 12;
constexpr double kPause_s = 0.3;
// The factor by which a joint may answer more strongly than the device without a hand.
constexpr double kStrong = 2.0;
// A joint whose unit moves the tool by less than this, m, cannot be asked.
constexpr double kLeastPulseLever = 1e-6;

}  // namespace

void MotorSignCheck::configure(const ControllerConfig& config) {
  const SafetyConfig& safety = config.safety;
  settings_ = {.joint_count = joint_count(config.mechanism),
               .most_N = safety.sign_check_N,
               .moving_mass_kg = safety.moving_mass_kg,
               .pause_ticks = static_cast<std::uint32_t>(std::ceil(kPause_s * config.rate_hz))};
  for (std::size_t i = 0; i < kJointCount; ++i) {
    settings_.max_effort[i] = config.joints[i].max_effort;
  }
  shape_ = pulse_shape(config.rate_hz, safety.device_delay_s);
  tables_ = pulse_tables(shape_);
  restart();
}

void MotorSignCheck::restart() {
  joints_ = {};
  for (Joint& joint : joints_) {
    joint.force_N = kFirstShare * settings_.most_N;
  }
  unanswered_ = settings_.most_N > 0.0 ? (1U << settings_.joint_count) - 1U : 0U;
  asked_ = 0;
  pass();
}

void MotorSignCheck::pass() {
  pulse_.is_running = false;
  ticks_to_wait_ = 0;
  push_ = {};
}

EffortFinding MotorSignCheck::step(const drivers::JointSample& sample, const Pose& pose,
                                   const JointEfforts& held) {
  EffortFinding found;
  push_ = {};
  if (is_done()) {
    return found;
  }
  if (pulse_.is_running && pulse_.advance(sample.position[asked_], held[asked_], shape_, tables_)) {
    found = judge();
    choose_next();
  }
  if (ticks_to_wait_ > 0) {
    --ticks_to_wait_;
  } else if (!pulse_.is_running && !is_done()) {
    begin_pulse(sample, pose);
  }
  push_[asked_] = pulse_.push(shape_);
  return found;
}

void MotorSignCheck::begin_pulse(const drivers::JointSample& sample, const Pose& pose) {
  const double lever = pose.jacobian_D.col(static_cast<Eigen::Index>(asked_)).norm();
  if (lever < kLeastPulseLever) {
    pass_turn();
    ticks_to_wait_ = settings_.pause_ticks;
    return;
  }
  const double most = kMostOfEffort * settings_.max_effort[asked_];
  pulse_.begin(sample.position[asked_], std::clamp(joints_[asked_].force_N * lever, -most, most));
  joints_[asked_].force_N = -joints_[asked_].force_N;
  most_gain_ = kStrong * free_gain(pose) * shape_.unit_s * shape_.unit_s;
}

// Returns the reciprocal of the inertia that the moving mass has at the joint; 0 if the mass is not
// known.
double MotorSignCheck::free_gain(const Pose& pose) const {
  if (settings_.moving_mass_kg <= 0.0) {
    return 0.0;
  }
  const double gain = joint_mobility(pose, settings_.joint_count,
                                     settings_.moving_mass_kg)[static_cast<Eigen::Index>(asked_)];
  return std::isfinite(gain) ? gain : 0.0;
}

EffortFinding MotorSignCheck::judge() {
  const auto [gain, is_clear] = answer_of(pulse_.sums);
  Joint& joint = joints_[asked_];
  const bool is_strong = most_gain_ > 0.0 && gain > most_gain_;
  joint.right = is_clear && gain > 0.0 && !is_strong ? joint.right + 1 : 0;
  joint.wrong = is_clear && gain < 0.0 ? joint.wrong + 1 : 0;
  joint.strong = is_clear && is_strong ? joint.strong + 1 : 0;
  joint.unclear = is_clear ? 0 : joint.unclear + 1;
  if (joint.right == kRight) {
    unanswered_ &= ~(1U << asked_);
  }
  if (joint.wrong < kWrong && joint.strong < kWrong) {
    return {};
  }
  return {.faults = joint.wrong >= kWrong ? kFaultMotorReversed : kFaultEffortMismatch,
          .joint = static_cast<std::uint32_t>(asked_ + 1)};
}

// Chooses the joint of the next pulse: the same one until it has answered or has been unclear for
// long enough.
void MotorSignCheck::choose_next() {
  Joint& joint = joints_[asked_];
  const bool is_answered = (unanswered_ >> asked_ & 1U) == 0;
  if (!is_answered && (joint.unclear == 0 || joint.unclear % kUnclear != 0)) {
    return;
  }
  joint.force_N = std::clamp(kStronger * joint.force_N, -settings_.most_N, settings_.most_N);
  ticks_to_wait_ = joint.unclear >= kMostUnclear ? settings_.pause_ticks : 0;
  joint.unclear = std::min(joint.unclear, kMostUnclear);
  pass_turn();
}

// Passes the turn to the next joint that has not answered; with a single one it is its turn again.
void MotorSignCheck::pass_turn() {
  for (std::size_t tried = 0; tried < settings_.joint_count; ++tried) {
    asked_ = (asked_ + 1) % settings_.joint_count;
    if ((unanswered_ >> asked_ & 1U) != 0) {
      return;
    }
  }
}

}  // namespace tactus::firmware
