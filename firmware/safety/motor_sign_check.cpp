#include "firmware/safety/motor_sign_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "firmware/kinematics/mobility.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// The length of a unit, and T.
constexpr double kUnit_s = 0.001;
constexpr double kQuarter_s = 0.006;
// The number of times T in a pulse: three times four.
constexpr std::size_t kQuarters = 12;
// The first pulse, as a share of the largest push.
constexpr double kFirstShare = 0.6;
// The ratio of the pulses before and after a joint was unclear.
constexpr double kStronger = 1.3;
// The largest pulse, as a share of the joint's largest effort.
constexpr double kMostOfEffort = 0.5;
// The share of the motion that the pulse must explain.
constexpr double kExplained = 0.5;
// The share of r that must lie along z: else the joint's other efforts outweigh the pulse.
constexpr double kInstrumentShare = 0.3;
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
constexpr double kLeastSignLever = 1e-6;

// The number of powers of a cubic.
constexpr std::size_t kCubic = 4;

// Returns the scalar product of the first `count` entries.
template <std::size_t kSize>
double dot(const std::array<double, kSize>& a, const std::array<double, kSize>& b,
           std::size_t count) {
  return std::inner_product(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(count), b.begin(),
                            0.0);
}

}  // namespace

void MotorSignCheck::configure(const ControllerConfig& config) {
  joint_count_ = joint_count(config.mechanism);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    max_effort_[i] = config.joints[i].max_effort;
  }
  most_N_ = config.safety.sign_check_N;
  ticks_a_unit_ =
      static_cast<std::uint32_t>(std::max(1.0, std::floor(kUnit_s * config.rate_hz + 0.5)));
  moving_mass_kg_ = config.safety.moving_mass_kg;
  unit_s_ = ticks_a_unit_ / config.rate_hz;
  quarter_ = static_cast<std::size_t>(std::max(1.0, std::round(kQuarter_s / unit_s_)));
  // The integral already contains half a tick of the delay: the hold of an effort up to its middle.
  const double delay_s = std::max(0.0, config.safety.device_delay_s - 0.5 / config.rate_hz);
  delay_ = std::min(kMaxDelay, static_cast<std::size_t>(std::round(delay_s / unit_s_)));
  samples_ = std::min(kMaxSamples, kQuarters * quarter_ + delay_ + 1);
  pause_ticks_ = static_cast<std::uint32_t>(std::ceil(kPause_s * config.rate_hz));
  prepare_tables();
  restart();
}

// Computes the orthonormal powers by two passes of Gram-Schmidt, which is exact enough here.
void MotorSignCheck::prepare_tables() {
  powers_ = {};
  instrument_ = {};
  double integral = 0.0;
  double double_integral = 0.0;
  for (std::size_t n = 0; n < samples_; ++n) {
    const double t = 2.0 * static_cast<double>(n) / static_cast<double>(samples_ - 1) - 1.0;
    powers_[n][0] = 1.0;
    for (std::size_t power = 1; power < kPowers; ++power) {
      powers_[n][power] = t * powers_[n][power - 1];
    }
    if (n > delay_) {
      const double effort = pattern(n - 1 - delay_);
      double_integral += integral + 0.5 * effort;
      integral += effort;
    }
    instrument_[n] = double_integral;
  }
  const auto remove = [this](const auto& of, const auto& to, std::size_t power) {
    double along = 0.0;
    for (std::size_t n = 0; n < samples_; ++n) {
      along += of(n) * powers_[n][power];
    }
    for (std::size_t n = 0; n < samples_; ++n) {
      to(n) -= along * powers_[n][power];
    }
  };
  const auto normalize = [this](const auto& of) {
    double squares = 0.0;
    for (std::size_t n = 0; n < samples_; ++n) {
      squares += of(n) * of(n);
    }
    for (std::size_t n = 0; n < samples_; ++n) {
      of(n) /= std::sqrt(squares);
    }
  };
  for (std::size_t power = 0; power < kPowers; ++power) {
    const auto column = [this, power](std::size_t n) -> double& { return powers_[n][power]; };
    for (std::size_t other = 0; other < 2 * power; ++other) {
      remove(column, column, other % power);
    }
    normalize(column);
  }
  const auto instrument = [this](std::size_t n) -> double& { return instrument_[n]; };
  for (std::size_t other = 0; other < 2 * kPowers; ++other) {
    remove(instrument, instrument, other % kPowers);
  }
  normalize(instrument);
}

double MotorSignCheck::pattern(std::size_t unit) const {
  if (unit >= kQuarters * quarter_) {
    return 0.0;
  }
  const std::size_t quarter = unit / quarter_ % 4;
  return quarter == 0 || quarter == 3 ? 1.0 : -1.0;
}

void MotorSignCheck::restart() {
  joints_ = {};
  for (Joint& joint : joints_) {
    joint.force_N = kFirstShare * most_N_;
  }
  unanswered_ = most_N_ > 0.0 ? (1U << joint_count_) - 1U : 0U;
  asked_ = 0;
  pass();
}

void MotorSignCheck::pass() {
  is_pulsing_ = false;
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
  if (is_pulsing_) {
    effort_sum_ += held[asked_];
    ++ticks_;
    if (ticks_ % ticks_a_unit_ == 0) {
      take_sample(sample.position[asked_] - start_, effort_sum_ / ticks_a_unit_);
      effort_sum_ = 0.0;
      if (ticks_ / ticks_a_unit_ + 1 == samples_) {
        is_pulsing_ = false;
        ticks_ = 0;
        found = judge();
        choose_next();
      }
    }
  }
  if (ticks_to_wait_ > 0) {
    --ticks_to_wait_;
  } else if (!is_pulsing_ && !is_done()) {
    begin_pulse(sample, pose);
  }
  if (is_pulsing_) {
    push_[asked_] = amplitude_ * pattern(ticks_ / ticks_a_unit_);
  }
  return found;
}

void MotorSignCheck::begin_pulse(const drivers::JointSample& sample, const Pose& pose) {
  const double lever = pose.jacobian_D.col(static_cast<Eigen::Index>(asked_)).norm();
  if (lever < kLeastSignLever) {
    choose_next();
    ticks_to_wait_ = pause_ticks_;
    return;
  }
  const double most = kMostOfEffort * max_effort_[asked_];
  amplitude_ = std::clamp(joints_[asked_].force_N * lever, -most, most);
  joints_[asked_].force_N = -joints_[asked_].force_N;
  most_gain_ = kStrong * free_gain(pose) * unit_s_ * unit_s_;
  is_pulsing_ = true;
  ticks_ = 0;
  start_ = sample.position[asked_];
  effort_sum_ = 0.0;
  efforts_ = {};
  effort_integral_ = 0.0;
  effort_double_integral_ = 0.0;
  sums_ = Sums{};
}

// Returns the reciprocal of the inertia that the moving mass has at the joint; 0 if the mass is not
// known.
double MotorSignCheck::free_gain(const Pose& pose) const {
  if (moving_mass_kg_ <= 0.0) {
    return 0.0;
  }
  const double gain =
      joint_mobility(pose, joint_count_, moving_mass_kg_)[static_cast<Eigen::Index>(asked_)];
  return std::isfinite(gain) ? gain : 0.0;
}

// Adds a sample to the sums. The first one is 0 and adds nothing.
void MotorSignCheck::take_sample(double position, double mean_effort) {
  const std::size_t n = ticks_ / ticks_a_unit_;
  efforts_[n % efforts_.size()] = mean_effort;
  if (n > delay_) {
    const double effort = efforts_[(n - delay_) % efforts_.size()];
    effort_double_integral_ += effort_integral_ + 0.5 * effort;
    effort_integral_ += effort;
  }
  const double y = position;
  const double r = effort_double_integral_;
  for (std::size_t power = 0; power < kPowers; ++power) {
    sums_.y_powers[power] += powers_[n][power] * y;
    sums_.r_powers[power] += powers_[n][power] * r;
  }
  sums_.z_y += instrument_[n] * y;
  sums_.z_r += instrument_[n] * r;
  sums_.y_y += y * y;
  sums_.y_r += y * r;
  sums_.r_r += r * r;
}

EffortFinding MotorSignCheck::judge() {
  // The products of y and r after a cubic is subtracted from each: the powers are orthonormal, so
  // the cubic's part is the sum of the products of the first four coefficients.
  const double y_y = sums_.y_y - dot(sums_.y_powers, sums_.y_powers, kCubic);
  const double y_r = sums_.y_r - dot(sums_.y_powers, sums_.r_powers, kCubic);
  const double r_r = sums_.r_r - dot(sums_.r_powers, sums_.r_powers, kCubic);
  const double gain = sums_.z_y / sums_.z_r;
  // The squared size of y - g r, both without their cubics.
  const double left = y_y - 2.0 * gain * y_r + gain * gain * r_r;
  const bool is_clear = y_y > 0.0 && left < (1.0 - kExplained) * y_y &&
                        sums_.z_r * sums_.z_r > kInstrumentShare * kInstrumentShare * r_r;
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
  joint.force_N = std::clamp(kStronger * joint.force_N, -most_N_, most_N_);
  ticks_to_wait_ = joint.unclear >= kMostUnclear ? pause_ticks_ : 0;
  joint.unclear = std::min(joint.unclear, kMostUnclear);
  for (std::size_t tried = 0; tried < joint_count_; ++tried) {
    asked_ = (asked_ + 1) % joint_count_;
    if ((unanswered_ >> asked_ & 1U) != 0) {
      return;
    }
  }
}

}  // namespace tactus::firmware
