#include "drivers/composition/hard_stop_search.h"

#include <algorithm>
#include <cmath>

namespace tactus::drivers {

namespace {

// Lengths, as the time in which a joint travels them at the search speed.
constexpr double kBackOff_s = 0.2;
constexpr double kBackOffWrongWay_s = 0.02;
constexpr double kStillBand_s = 0.01;  // in kStanding_ns: a twentieth of the search speed
// Shares of the length of the back-off move.
constexpr double kBackOffShare = 0.1;  // the largest share of the free travel
constexpr double kSamePlaceShare = 0.2;
constexpr double kWrongWayShare = 0.25;
constexpr double kBackOffStillShare = 0.1;

}  // namespace

HardStopSearch::HardStopSearch(const HardStopLimits& limits)
    : limits_(limits),
      way_(std::copysign(1.0, limits.effort)),
      min_travel_(limits.min_travel > 0.0 ? limits.min_travel : kRangeShare * limits.range),
      back_off_(std::min(kBackOff_s * limits.speed, kBackOffShare * min_travel_)),
      same_place_(kSamePlaceShare * back_off_),
      move_({.effort = std::abs(limits.effort),
             .speed = limits.speed,
             .wrong_way = std::min(kBackOffWrongWay_s * limits.speed, kWrongWayShare * back_off_),
             .still_band = std::min(kStillBand_s * limits.speed, kBackOffStillShare * back_off_),
             .time_ns = limits.time_ns}) {}

void HardStopSearch::begin(double position, hal::TimeNs now_ns) {
  *this = HardStopSearch(limits_);
  if (!std::isfinite(min_travel_)) {
    fail(HomingFailure::range_unknown);
    return;
  }
  enter(Phase::approach, way_, position, now_ns);
}

void HardStopSearch::enter(Phase phase, double way, double position, hal::TimeNs now_ns) {
  phase_ = phase;
  move_.begin(way, position, now_ns);
}

void HardStopSearch::fail(HomingFailure failure) {
  failure_ = failure;
}

double HardStopSearch::effort() const {
  return failure_ == HomingFailure::none && phase_ != Phase::done ? move_.effort() : 0.0;
}

void HardStopSearch::advance(double position, double velocity, hal::TimeNs now_ns) {
  if (failure_ != HomingFailure::none || phase_ == Phase::done) {
    return;
  }
  move_.advance(position, velocity, now_ns);
  if (move_.failure() != HomingFailure::none) {
    fail(move_.failure());
    return;
  }
  switch (phase_) {
    case Phase::approach:
      approach(position, now_ns);
      return;
    case Phase::back_off:
      back_off(position, now_ns);
      return;
    case Phase::turn:
      if (move_.stands()) {
        enter(Phase::again, way_, position, now_ns);
      }
      return;
    case Phase::again:
      come_again(position, now_ns);
      return;
    case Phase::cross:
      cross(position, now_ns);
      return;
    case Phase::rest:
      phase_ = move_.stands() ? Phase::done : Phase::rest;
      return;
    case Phase::done:
      return;
  }
}

void HardStopSearch::approach(double position, hal::TimeNs now_ns) {
  moved_ = moved_ || move_.travel() > back_off_;
  if (move_.travel() > kMostRanges * std::max(limits_.range, min_travel_)) {
    fail(HomingFailure::beyond_range);
  } else if (move_.stands()) {
    stop_ = position;
    enter(Phase::back_off, -way_, position, now_ns);
  }
}

void HardStopSearch::back_off(double position, hal::TimeNs now_ns) {
  if (move_.travel() >= back_off_) {
    enter(Phase::turn, 0.0, position, now_ns);
  } else if (move_.stands()) {
    fail(moved_ ? HomingFailure::short_travel : HomingFailure::did_not_move);
  }
}

void HardStopSearch::come_again(double position, hal::TimeNs now_ns) {
  const double past = way_ * (position - stop_);
  if (past > same_place_ || (move_.stands() && past < -same_place_)) {
    fail(HomingFailure::stop_moved);
  } else if (move_.stands()) {
    stop_ = position;
    enter(Phase::cross, -way_, position, now_ns);
  }
}

void HardStopSearch::cross(double position, hal::TimeNs now_ns) {
  if (move_.travel() >= min_travel_) {
    enter(Phase::rest, 0.0, position, now_ns);
  } else if (move_.stands()) {
    fail(HomingFailure::short_travel);
  }
}

}  // namespace tactus::drivers
