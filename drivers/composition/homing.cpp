#include "drivers/composition/homing.h"

#include <algorithm>
#include <cmath>

namespace tactus::drivers {

namespace {

// A joint that is held still may move by this share of its range. Without a known range it may move
// as far as it travels in this time at the search speed.
constexpr double kStillShare = 0.01;
constexpr double kStillSpeed_s = 0.02;
// The same for an index search by motor: a move against the push that shows a wrong sign, and a
// band in which the joint stands. Both are times at the search speed.
constexpr double kWrongWay_s = 0.02;
constexpr double kStand_s = 0.01;
// An index may put the joint outside its limits by this share of its range.
constexpr double kOutsideShare = 0.05;

double still_band(const Reference& reference) {
  const double range = reference.upper - reference.lower;
  return std::isfinite(range) ? kStillShare * range : kStillSpeed_s * reference.search_speed;
}

hal::TimeNs in_ns(double seconds) {
  return static_cast<hal::TimeNs>(seconds * 1e9);
}

HardStopLimits stop_limits(const Reference& reference) {
  const bool is_low = reference.search_effort < 0.0;
  return {
      .effort = reference.search_effort,
      .speed = reference.search_speed,
      .range = is_low ? reference.upper - reference.position : reference.position - reference.lower,
      .min_travel = reference.min_travel,
      .time_ns = in_ns(reference.time_limit_s)};
}

// Returns true if the stop lies on the side of the range to which the search pushes.
bool stop_is_at_its_end(const Reference& reference) {
  const double range = reference.upper - reference.lower;
  if (reference.kind != ReferenceKind::hard_stop || !std::isfinite(range)) {
    return true;
  }
  const double middle = reference.lower + 0.5 * range;
  return reference.search_effort < 0.0 ? reference.position < middle : reference.position > middle;
}

}  // namespace

Checked check(const Reference& reference) {
  if (!std::isfinite(reference.position)) {
    return std::unexpected(FieldError{"position", "must be a number"});
  }
  if (!std::isfinite(reference.search_effort)) {
    return std::unexpected(FieldError{"search_effort", "must be a number"});
  }
  if (reference.kind == ReferenceKind::hard_stop && reference.search_effort == 0.0) {
    return std::unexpected(
        FieldError{"search_effort", "must not be 0: a hard stop is found by the motor"});
  }
  if (!lies_between(reference.search_speed, 1e-6, 100.0)) {
    return std::unexpected(FieldError{"search_speed", "must be above 0, up to 100"});
  }
  if (!lies_between(reference.time_limit_s, 0.1, 600.0)) {
    return std::unexpected(FieldError{"time_limit_s", "must lie between 0.1 and 600"});
  }
  if (!(reference.lower < reference.upper)) {
    return std::unexpected(FieldError{"lower", "must be below upper"});
  }
  if (!lies_between(reference.min_travel, 0.0, 1e6)) {
    return std::unexpected(FieldError{"min_travel", "must be 0 or above"});
  }
  if (!stop_is_at_its_end(reference)) {
    return std::unexpected(
        FieldError{"search_effort", "pushes to one end of the range, position is at the other"});
  }
  return {};
}

Homing::Homing(const Reference& reference, const Transmission& transmission)
    : reference_(reference), transmission_(transmission), stop_(stop_limits(reference)) {
  lose();
}

void Homing::lose() {
  state_ = reference_.kind == ReferenceKind::absolute ? State::referenced : State::waiting;
  failure_ = HomingFailure::none;
  effort_ = 0.0;
}

double Homing::position(const AxisSample& sample) const {
  return joint_position(transmission_, sample.position_rad);
}

double Homing::velocity(const AxisSample& sample) const {
  return joint_velocity(transmission_, sample.velocity_rad_per_s);
}

void Homing::advance(const AxisSample& sample, bool home, hal::TimeNs now_ns) {
  if (state_ == State::waiting && home) {
    begin(sample, now_ns);
  }
  if (state_ != State::searching) {
    return;
  }
  if (!home) {  // withdrawn
    lose();
    return;
  }
  if ((sample.status & kDeviceStale) != 0) {
    still_.since_ns = now_ns;
    move_.skip(now_ns);
    stop_.skip(now_ns);
    return;
  }
  search(sample, now_ns);
}

void Homing::begin(const AxisSample& sample, hal::TimeNs now_ns) {
  since_ns_ = now_ns;
  still_ = {.position = position(sample), .since_ns = now_ns};
  old_index_rad_ = sample.index_seen ? std::optional(sample.index_rad) : std::nullopt;
  state_ = State::searching;
  switch (reference_.kind) {
    case ReferenceKind::absolute:
    case ReferenceKind::board:
      state_ = State::referenced;
      return;
    case ReferenceKind::known_pose:
      return;
    case ReferenceKind::index:
      move_ = SearchMove({.effort = std::abs(reference_.search_effort),
                          .speed = reference_.search_speed,
                          .wrong_way = kWrongWay_s * reference_.search_speed,
                          .still_band = kStand_s * reference_.search_speed,
                          .time_ns = in_ns(reference_.time_limit_s)});
      move_.begin(std::copysign(1.0, reference_.search_effort), position(sample), now_ns);
      return;
    case ReferenceKind::hard_stop:
      stop_.begin(position(sample), now_ns);
      return;
  }
}

void Homing::search(const AxisSample& sample, hal::TimeNs now_ns) {
  if (!std::isfinite(sample.position_rad) || !std::isfinite(sample.velocity_rad_per_s)) {
    fail(HomingFailure::not_a_number);
  } else if (reference_.kind == ReferenceKind::hard_stop) {
    search_stop(sample, now_ns);
  } else if (reference_.kind == ReferenceKind::index) {
    search_index(sample, now_ns);
  } else {
    hold_still(sample, now_ns);
  }
}

void Homing::hold_still(const AxisSample& sample, hal::TimeNs now_ns) {
  if (std::abs(position(sample) - still_.position) > still_band(reference_)) {
    still_ = {.position = position(sample), .since_ns = now_ns};
  }
  if (now_ns - still_.since_ns >= kStill_ns) {
    found(sample.position_rad);
  } else if (now_ns - since_ns_ > in_ns(reference_.time_limit_s)) {
    fail(HomingFailure::not_still);
  }
}

// Returns true if the pulse was seen in this search. A pulse from before may have been counted from
// another zero.
bool Homing::is_new_index(const AxisSample& sample) const {
  return sample.index_seen && sample.index_rad != old_index_rad_;
}

void Homing::search_index(const AxisSample& sample, hal::TimeNs now_ns) {
  if (is_new_index(sample)) {
    found(sample.index_rad);
    const double slack = kOutsideShare * (reference_.upper - reference_.lower);
    const double joint = position(sample);
    if (joint < reference_.lower - slack || joint > reference_.upper + slack) {
      fail(HomingFailure::index_elsewhere);
    }
    return;
  }
  if (now_ns - since_ns_ > in_ns(reference_.time_limit_s)) {
    fail(HomingFailure::no_index);
  } else if (reference_.search_effort != 0.0) {
    move_.advance(position(sample), velocity(sample), now_ns);
    effort_ = move_.effort();
    if (move_.failure() != HomingFailure::none) {
      fail(move_.failure());
    } else if (move_.stands()) {
      fail(HomingFailure::no_index);
    }
  }
}

void Homing::search_stop(const AxisSample& sample, hal::TimeNs now_ns) {
  stop_.advance(position(sample), velocity(sample), now_ns);
  effort_ = stop_.effort();
  if (stop_.failure() != HomingFailure::none) {
    fail(stop_.failure());
  } else if (stop_.is_done()) {
    found(encoder_position_rad(transmission_, stop_.stop()));
  }
}

void Homing::fail(HomingFailure failure) {
  failure_ = failure;
  effort_ = 0.0;
  state_ = State::failed;
}

void Homing::found(double encoder_rad) {
  transmission_.offset = offset_at(transmission_, encoder_rad, reference_.position);
  effort_ = 0.0;
  state_ = State::referenced;
}

Trouble Homing::trouble() const {
  return state_ == State::failed ? describe(failure_) : Trouble{};
}

}  // namespace tactus::drivers
