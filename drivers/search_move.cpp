#include "drivers/search_move.h"

#include <algorithm>
#include <cmath>

namespace tactus::drivers {

namespace {

// The part of the effort that is always asked for, so that the motor keeps its power in the move.
constexpr double kLeastShare = 0.01;
// Speeds are judged over so long, with so much of the search speed's travel for noise.
constexpr hal::TimeNs kSpeedWindow_ns = 100'000'000;
constexpr double kSpeedSlack_s = 0.02;

double in_seconds(hal::TimeNs time_ns) {
  return static_cast<double>(time_ns) * 1e-9;
}

}  // namespace

void SearchMove::begin(double way, double position, hal::TimeNs now_ns) {
  way_ = way;
  from_ = position;
  travel_ = 0.0;
  effort_ = 0.0;
  still_at_ = position;
  checked_at_ = position;
  began_ns_ = now_ns;
  still_since_ns_ = now_ns;
  checked_ns_ = now_ns;
  stands_ = false;
}

void SearchMove::advance(double position, double velocity, hal::TimeNs now_ns) {
  watch(position, velocity, now_ns);
  if (failure_ != HomingFailure::none) {
    effort_ = 0.0;
    return;
  }
  push(velocity, now_ns);
}

void SearchMove::watch(double position, double velocity, hal::TimeNs now_ns) {
  if (!std::isfinite(position) || !std::isfinite(velocity)) {
    failure_ = HomingFailure::not_a_number;
    return;
  }
  const double passed_s = in_seconds(now_ns - checked_ns_) * kFastest + kSpeedSlack_s;
  if (std::abs(position - checked_at_) > limits_.speed * passed_s) {
    failure_ = HomingFailure::too_fast;
    return;
  }
  if (now_ns - checked_ns_ >= kSpeedWindow_ns) {
    checked_at_ = position;
    checked_ns_ = now_ns;
  }
  travel_ = way_ * (position - from_);
  if (travel_ < -limits_.wrong_way) {
    failure_ = HomingFailure::wrong_way;
    return;
  }
  follows_ = follows_ || travel_ > limits_.wrong_way;
  if (now_ns - began_ns_ > limits_.time_ns) {
    failure_ = HomingFailure::took_too_long;
    return;
  }
  const bool full = way_ == 0.0 || now_ns - began_ns_ >= kRise_ns;
  if (!full || std::abs(position - still_at_) > limits_.still_band) {
    still_at_ = position;
    still_since_ns_ = now_ns;
  }
  stands_ = now_ns - still_since_ns_ >= kStanding_ns;
}

void SearchMove::push(double velocity, hal::TimeNs now_ns) {
  const double risen = std::min(1.0, in_seconds(now_ns - began_ns_) / in_seconds(kRise_ns));
  const double speed = velocity / limits_.speed;
  double share = way_ * std::clamp(risen - std::abs(speed), kLeastShare, 1.0);
  if (follows_) {
    // Full push when it stands, none at the search speed, as much the other way at twice that.
    share = std::clamp(way_ * risen - speed, -1.0, 1.0);
  }
  if (std::abs(share) < kLeastShare) {
    share = std::copysign(kLeastShare, way_);
  }
  effort_ = limits_.effort * share;
}

}  // namespace tactus::drivers
