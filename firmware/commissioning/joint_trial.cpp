#include "firmware/commissioning/joint_trial.h"

#include <algorithm>
#include <cmath>

namespace tactus::firmware {
namespace {

// The length of a quarter of a pulse. A pulse has a push out, a push back (two quarters) and a
// brake; the mirrored pulse and a rest of two quarters follow, so that a delayed answer is still
// recorded.
constexpr double kQuarter_s = 0.02;
constexpr std::size_t kQuartersOfAPulse = 4;
constexpr std::size_t kQuarters = (2 * kQuartersOfAPulse) + 2;

// A joint counts as at rest if it stays within a band for this time.
constexpr double kStill_s = 0.2;
constexpr double kLongestSettling_s = 10.0;
// The width of the band, as a share of the wanted travel.
constexpr double kBandShare = 0.1;
// The ratio of the efforts of two pulses in a row.
constexpr double kGrowth = 1.6;
// The travel of a measured pulse in encoder counts: the steps of the counts are then 4 % of it.
constexpr double kWantedQuanta = 25.0;
// The largest share of the pulse that friction may take. Above it the inertia would be the
// difference of two nearly equal numbers.
constexpr double kMostFriction = 0.2;

// Returns true if the sample can be used. An old sample can: the pulse is a record over many ticks.
bool is_well(const drivers::JointSample& sample, std::size_t joint) {
  return (sample.status & ~static_cast<std::uint32_t>(drivers::kDeviceStale)) == 0 &&
         std::isfinite(sample.position[joint]);
}

}  // namespace

double JointTrial::tick(const drivers::JointSample& sample) {
  if (end_ != TrialEnd::running) {
    return 0.0;
  }
  if (!is_well(sample, config_.joint)) {
    end_ = TrialEnd::sample_bad;
    return 0.0;
  }
  return phase_ == Phase::settling ? settle(sample) : pulse(sample);
}

double JointTrial::settle(const drivers::JointSample& sample) {
  const double band = kBandShare * config_.wanted_travel;
  const double moved = std::abs(sample.position[config_.joint] - start_.position[config_.joint]);
  ++settling_ticks_;
  if (still_ticks_ == 0 || moved > band) {
    start_ = sample;
    still_ticks_ = 0;
  }
  ++still_ticks_;
  if (settling_ticks_ > kLongestSettling_s * config_.rate_hz) {
    end_ = TrialEnd::never_still;
    return 0.0;
  }
  if (still_ticks_ < kStill_s * config_.rate_hz) {
    return 0.0;
  }
  effort_ = effort_ == 0.0 ? config_.first_effort : kGrowth * effort_;
  effort_ = std::min(effort_, config_.most_effort);
  phase_ = Phase::pulsing;
  start_ = sample;
  record_.count = 0;
  record_.has_reported = true;
  travel_.fill(0.0);
  return pulse(sample);
}

std::size_t JointTrial::samples() const {
  const double wanted = std::round(kQuarter_s * config_.rate_hz) * static_cast<double>(kQuarters);
  return std::min(kMaxPulseSamples, static_cast<std::size_t>(wanted));
}

// Returns the sign of the effort at sample k: + - - +, then - + + -, then 0.
double JointTrial::pattern(std::size_t k) const {
  const std::size_t quarter = k * kQuarters / samples();
  if (quarter >= 2 * kQuartersOfAPulse) {
    return 0.0;
  }
  const double side = quarter < kQuartersOfAPulse ? 1.0 : -1.0;
  const std::size_t part = quarter % kQuartersOfAPulse;
  return part == 0 || part == kQuartersOfAPulse - 1 ? side : -side;
}

double JointTrial::pulse(const drivers::JointSample& sample) {
  const std::size_t k = record_.count;
  for (std::size_t i = 0; i < drivers::kMaxJoints; ++i) {
    travel_[i] = std::max(travel_[i], std::abs(sample.position[i] - start_.position[i]));
  }
  const double effort = effort_ * pattern(k);
  record_.position[k] = sample.position[config_.joint];
  record_.effort[k] = effort;
  record_.reported[k] = sample.effort[config_.joint];
  record_.has_reported = record_.has_reported && ((sample.effort_known >> config_.joint) & 1U) != 0;
  ++record_.count;
  if (travel_[config_.joint] > config_.largest_travel) {
    fit_ = fit_pulse(record_, 1.0 / config_.rate_hz);
    end_ = TrialEnd::went_too_far;
    return 0.0;
  }
  if (record_.count == samples()) {
    judge();
    return 0.0;
  }
  return effort;
}

void JointTrial::judge() {
  fit_ = fit_pulse(record_, 1.0 / config_.rate_hz);
  const double wanted = std::max(config_.wanted_travel, kWantedQuanta * fit_.quantum);
  // Half of the largest travel is enough where the wanted one cannot be reached safely.
  const bool is_far_enough = fit_.travel >= std::min(wanted, 0.5 * config_.largest_travel);
  const bool is_strong_enough = fit_.friction <= kMostFriction * effort_;
  if (is_far_enough && (is_strong_enough || effort_ >= config_.most_effort)) {
    end_ = TrialEnd::measured;
  } else if (effort_ >= config_.most_effort) {
    end_ = TrialEnd::no_motion;
  } else {
    phase_ = Phase::settling;
    still_ticks_ = 0;
    settling_ticks_ = 0;
  }
}

}  // namespace tactus::firmware
