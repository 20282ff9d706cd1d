#include "drivers/homing.h"

#include <algorithm>
#include <cmath>

namespace tactus::drivers {

namespace {

// A joint that is pushed and slower than this part of its search speed stands.
constexpr double kStandingShare = 0.05;
// For so long, before that counts as the stop: longer than stiction or a gear's play holds it.
constexpr hal::TimeNs kStanding_ns = 200'000'000;

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
  return {};
}

Homing::Homing(const Reference& reference, const Transmission& transmission)
    : reference_(reference), transmission_(transmission) {
  lose();
}

void Homing::lose() {
  state_ = reference_.kind == ReferenceKind::absolute ? State::referenced : State::waiting;
  effort_ = 0.0;
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
  search(sample, now_ns);
}

void Homing::begin(const AxisSample& sample, hal::TimeNs now_ns) {
  since_ns_ = now_ns;
  moved_ns_ = now_ns;
  switch (reference_.kind) {
    case ReferenceKind::absolute:
    case ReferenceKind::board:
      state_ = State::referenced;
      return;
    case ReferenceKind::known_pose:
      found(sample.position_rad);
      return;
    case ReferenceKind::index:
    case ReferenceKind::hard_stop:
      state_ = State::searching;
      return;
  }
}

void Homing::search(const AxisSample& sample, hal::TimeNs now_ns) {
  const double speed = joint_velocity(transmission_, sample.velocity_rad_per_s);
  if (reference_.kind == ReferenceKind::index && sample.index_seen) {
    found(sample.index_rad);
    return;
  }
  if (reference_.kind == ReferenceKind::hard_stop && stands_at_stop(speed, now_ns)) {
    found(sample.position_rad);
    return;
  }
  if (static_cast<double>(now_ns - since_ns_) > reference_.time_limit_s * 1e9) {
    state_ = State::failed;
    effort_ = 0.0;
    return;
  }
  // Full push when it stands, none at the search speed, as much the other way at twice that.
  const double push = reference_.search_effort;
  const double along = std::copysign(speed, push * speed);
  effort_ = push * std::clamp(1.0 - along / reference_.search_speed, -1.0, 1.0);
}

bool Homing::stands_at_stop(double speed, hal::TimeNs now_ns) {
  if (std::abs(speed) > kStandingShare * reference_.search_speed) {
    moved_ns_ = now_ns;
  }
  return now_ns - moved_ns_ >= kStanding_ns;
}

void Homing::found(double encoder_rad) {
  transmission_.offset = offset_at(transmission_, encoder_rad, reference_.position);
  effort_ = 0.0;
  state_ = State::referenced;
}

Trouble Homing::trouble() const {
  if (state_ != State::failed) {
    return {};
  }
  if (reference_.kind == ReferenceKind::index) {
    return {"homing saw no index pulse in its time",
            "move the joint over its index; check the index's wiring, then reset and home", 0};
  }
  return {"homing found no stop in its time",
          "check search_effort, search_speed and that the joint moves freely, then reset and home",
          0};
}

}  // namespace tactus::drivers
