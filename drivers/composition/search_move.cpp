#include "drivers/composition/search_move.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tactus::drivers {

namespace {

// The share of the effort that is always commanded, so that the motor keeps its power in the move.
constexpr double kLeastShare = 0.01;
// A push of this share of the effort counts as the full push.
constexpr double kFullShare = 0.95;
// Speeds are judged over this time. The travel at this share of the search speed is allowed for
// noise.
constexpr hal::TimeNs kSpeedWindow_ns = 100'000'000;
constexpr double kSpeedSlack_s = 0.02;

struct HomingText {
  HomingFailure failure;
  std::string_view what;
  std::string_view remedy;
};

constexpr std::array kHomingTexts{
    HomingText{HomingFailure::not_a_number, "homing: the position or the velocity is not a number",
               "check the encoder and its cable, then reset and home"},
    HomingText{HomingFailure::too_fast,
               "homing: the joint jumped or moved faster than 3 times search_speed",
               "check encoder_direction, motor_direction, the encoder's cable and scale, and that "
               "nobody moves the joint; then reset and home"},
    HomingText{HomingFailure::wrong_way, "homing: the joint moves against the push",
               "encoder_direction or motor_direction is wrong, or a hand or its weight pushes "
               "harder than search_effort; then reset and home"},
    HomingText{HomingFailure::did_not_move, "homing: the joint did not move under search_effort",
               "check that the motor is plugged in and the brake open, that nothing holds the "
               "joint, and search_effort; then reset and home"},
    HomingText{HomingFailure::took_too_long, "homing found no stop in its time",
               "check search_effort, search_speed and that the joint moves freely; raise "
               "time_limit_s for a long way; then reset and home"},
    HomingText{HomingFailure::stop_moved,
               "homing: the joint stopped in two places, so an obstacle stopped it",
               "take hands and things out of its way, then reset and home"},
    HomingText{HomingFailure::short_travel, "homing: the joint moves less than its range",
               "take hands and things out of its way; check lower, upper, the stop's position and "
               "encoder_ratio; a smaller way is declared by min_travel; then reset and home"},
    HomingText{HomingFailure::beyond_range,
               "homing: the joint moved twice its range without a stop",
               "check encoder_ratio, the counts of a turn, lower and upper, and that the encoder "
               "does not slip; then reset and home"},
    HomingText{HomingFailure::range_unknown, "homing by hard stop needs the joint's range",
               "give the joint's lower and upper limits, or min_travel"},
    HomingText{HomingFailure::no_index, "homing saw no index pulse",
               "move the joint over its index while it homes; check the index's wiring and the "
               "way of search_effort, then reset and home"},
    HomingText{HomingFailure::index_elsewhere,
               "homing: the index would put the joint outside its limits",
               "check the index's position, lower and upper, and that the search begins within a "
               "turn of the right pulse; then reset and home"},
    HomingText{HomingFailure::not_still, "homing: the joint was not held still in its known pose",
               "hold it still there for half a second: reset and home"},
};

double in_seconds(hal::TimeNs time_ns) {
  return static_cast<double>(time_ns) * 1e-9;
}

}  // namespace

Trouble describe(HomingFailure failure) {
  for (const HomingText& text : kHomingTexts) {
    if (text.failure == failure) {
      return {text.what, text.remedy, 0};
    }
  }
  return {};
}

void SearchMove::begin(double way, double position, hal::TimeNs now_ns) {
  way_ = way;
  travel_ = 0.0;
  effort_ = 0.0;
  begun_ = {.position = position, .time_ns = now_ns};
  standstill_.restart(begun_);
  checked_ = begun_;
  last_ = begun_;
}

void SearchMove::advance(double position, double velocity, hal::TimeNs now_ns) {
  const Place place{.position = position, .time_ns = now_ns};
  watch(place, velocity);
  if (failure_ != HomingFailure::none) {
    effort_ = 0.0;
    return;
  }
  push(velocity, now_ns);
  last_ = place;
}

void SearchMove::watch(const Place& place, double velocity) {
  if (!std::isfinite(place.position) || !std::isfinite(velocity)) {
    failure_ = HomingFailure::not_a_number;
    return;
  }
  if (moves_too_fast(place)) {
    failure_ = HomingFailure::too_fast;
    return;
  }
  if (place.time_ns - checked_.time_ns >= kSpeedWindow_ns) {
    checked_ = place;
  }
  travel_ = way_ * (place.position - begun_.position);
  if (travel_ < -limits_.wrong_way) {
    failure_ = HomingFailure::wrong_way;
    return;
  }
  follows_ = follows_ || travel_ > limits_.wrong_way;
  if (place.time_ns - begun_.time_ns > limits_.time_ns) {
    failure_ = HomingFailure::took_too_long;
    return;
  }
  const bool has_full_push = way_ == 0.0 || std::abs(effort_) > kFullShare * limits_.effort;
  standstill_.take(place, has_full_push, limits_.still_band);
}

void SearchMove::Standstill::take(const Place& place, bool has_full_push, double band) {
  if (!has_full_push || std::abs(place.position - since_.position) > band) {
    since_ = place;
  }
  is_reached_ = place.time_ns - since_.time_ns >= kStanding_ns;
}

// Checks the speed since the last tick, and over a window that is long against the encoder's
// counts.
bool SearchMove::moves_too_fast(const Place& place) const {
  const auto is_too_far_from = [&](const Place& earlier) {
    const double passed_s = in_seconds(place.time_ns - earlier.time_ns);
    return std::abs(place.position - earlier.position) >
           limits_.speed * (kFastest * passed_s + kSpeedSlack_s);
  };
  return is_too_far_from(checked_) || is_too_far_from(last_);
}

void SearchMove::push(double velocity, hal::TimeNs now_ns) {
  const double risen = std::min(1.0, in_seconds(now_ns - begun_.time_ns) / in_seconds(kRise_ns));
  const double speed = velocity / limits_.speed;
  double share = way_ * std::clamp(risen - std::abs(speed), kLeastShare, 1.0);
  if (follows_) {
    // The push is full when the joint stands, zero at the search speed, and full in the other
    // direction at twice that speed.
    share = std::clamp(way_ * risen - speed, -1.0, 1.0);
  }
  if (std::abs(share) < kLeastShare) {
    share = std::copysign(kLeastShare, way_);
  }
  const double before = share * effort_ > 0.0 ? std::abs(effort_) / limits_.effort : 0.0;
  const double most =
      std::max(kLeastShare, before + in_seconds(now_ns - last_.time_ns) / in_seconds(kRise_ns));
  effort_ = limits_.effort * std::clamp(share, -most, most);
}

}  // namespace tactus::drivers
