// The bodies of a world that sleep, and what wakes them.
#include <algorithm>

#include "rendering/bodies/body_world.h"

namespace tactus::rendering {
namespace {

// Returns true if the largest speed of a body's points is that of a body at rest.
bool is_still(const RigidBody& body, const PlacedHull& hull) {
  const double reach_m = (hull.middle_W() - body.motion().center_W).norm() + hull.reach_m();
  return body.motion().velocity_W.norm() + reach_m * body.angular_velocity_W().norm() <
         kSleepSpeed_m_per_s;
}

}  // namespace

void BodyWorld::list_awake() {
  awake_count_ = 0;
  for (std::size_t i = 0; i < body_count_; ++i) {
    if (!sleep_.is_asleep(i)) {
      awake_[awake_count_++] = static_cast<std::uint8_t>(i);
    }
  }
}

bool BodyWorld::is_all_asleep() const {
  return awake_count_ == 0 &&
         std::ranges::none_of(std::span(obstacle_moves_).first(obstacle_count_),
                              [](bool moves) { return moves; });
}

// The contacts are found as those of bodies that are awake, and not kept.
bool BodyWorld::wakes(std::uint16_t solid, std::uint16_t sleeper, double tick_s,
                      const Margins& margins) {
  if (solid >= body_count_ && sleep_.rests_on(sleeper, solid)) {
    return true;
  }
  const std::uint16_t a = solid < body_count_ ? std::min(solid, sleeper) : solid;
  const std::uint16_t b = solid < body_count_ ? std::max(solid, sleeper) : sleeper;
  const double margin_m = margin_of(a, b, tick_s, margins);
  if (solid < body_count_) {
    const double apart_m = (hulls_[a].middle_W() - hulls_[b].middle_W()).norm();
    if (apart_m > hulls_[a].reach_m() + hulls_[b].reach_m() + margin_m) {
      return false;
    }
  }
  const bool left_out = left_out_;
  find_contacts_with(a, b, margin_m);
  const bool meets = contact_count_ > 0;
  contact_count_ = 0;
  left_out_ = left_out;
  return meets;
}

// A body that wakes may wake others, so the search begins anew with it.
void BodyWorld::wake_neighbours(double tick_s, Margins& margins) {
  const auto solid_count = static_cast<std::uint16_t>(body_count_ + obstacle_count_);
  const auto bodies = static_cast<std::uint16_t>(body_count_);
  const auto find_woken = [&]() -> std::uint16_t {
    for (std::uint16_t b = 0; b < bodies; ++b) {
      for (std::uint16_t a = 0; sleep_.is_asleep(b) && a < solid_count; ++a) {
        const bool may_wake = a < bodies ? !sleep_.is_asleep(a) : is_moving_obstacle(a);
        if (may_wake && wakes(a, b, tick_s, margins)) {
          return b;
        }
      }
    }
    return bodies;
  };
  for (std::uint16_t woken = find_woken(); woken < bodies; woken = find_woken()) {
    for (std::uint16_t i = 0; i < bodies; ++i) {
      if (sleep_.is_one_island(i, woken)) {
        take_body(i);
        margins[i] = place_hull(i, tick_s);
      }
    }
    sleep_.wake(woken);
    list_awake();
  }
}

void BodyWorld::rest_bodies(double tick_s, std::span<const FingerGrip> grips) {
  if (!sleep_.is_on()) {
    return;
  }
  std::array<bool, kMaxBodies> is_moved{};
  for (const FingerGrip& grip : grips) {
    is_moved[grip.body] = true;
  }
  const auto contacts = std::span(contacts_).first(contact_count_);
  for (const BodyContact& contact : contacts) {
    is_moved[contact.b] = is_moved[contact.b] || is_moving_obstacle(contact.a);
  }
  for (const std::uint8_t i : awake()) {
    sleep_.count_rest(i, !is_moved[i] && is_still(bodies_[i], hulls_[i]), tick_s);
  }
  if (left_out_ || !sleep_.fall_asleep(body_count_, contacts)) {
    return;
  }
  for (const std::uint8_t i : awake()) {
    if (sleep_.is_asleep(i)) {
      BodyMotion motion = bodies_[i].motion();
      motion.velocity_W.setZero();
      motion.angular_momentum_W.setZero();
      bodies_[i].set_motion(motion);
      place_body(i);
    }
  }
}

}  // namespace tactus::rendering
