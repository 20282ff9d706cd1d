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

// The contacts are looked for as those of bodies that are awake, and not kept.
bool BodyWorld::wakes(std::uint16_t solid, std::uint16_t sleeper, double tick_s,
                      const Margins& margins) {
  const bool is_body = solids_.is_body(solid);
  if (!is_body && sleep_.rests_on(sleeper, solid)) {
    return true;
  }
  const std::uint16_t a = is_body ? std::min(solid, sleeper) : solid;
  const std::uint16_t b = is_body ? std::max(solid, sleeper) : sleeper;
  const double margin_m = margin_of(a, b, tick_s, margins);
  if (is_body && are_apart(hulls_.whole(a), hulls_.whole(b), margin_m)) {
    return false;
  }
  return !meeting_.find(solids_, hulls_, a, b, margin_m).empty();
}

// A body that wakes may wake others, so the search begins anew with it.
void BodyWorld::wake_neighbours(double tick_s, Margins& margins) {
  const std::uint16_t bodies = solids_.body_count();
  const auto find_woken = [&]() -> std::uint16_t {
    for (std::uint16_t b = 0; b < bodies; ++b) {
      for (std::uint16_t a = 0; sleep_.is_asleep(b) && a < solids_.count(); ++a) {
        const bool may_wake = a < bodies ? !sleep_.is_asleep(a) : solids_.is_moving_obstacle(a);
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
        solver_.take_body(solids_, i);
        margins[i] = place_hull(i, tick_s);
      }
    }
    sleep_.wake(woken);
    awake_.list(sleep_, bodies);
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
  for (const BodyContact& contact : contacts_.all()) {
    is_moved[contact.b] = is_moved[contact.b] || solids_.is_moving_obstacle(contact.a);
  }
  for (const std::uint8_t i : awake_.numbers()) {
    sleep_.count_rest(i, !is_moved[i] && is_still(bodies()[i], hulls_.whole(i)), tick_s);
  }
  if (contacts_.has_left_out() || !sleep_.fall_asleep(solids_.body_count(), contacts_.all())) {
    return;
  }
  for (const std::uint8_t i : awake_.numbers()) {
    if (sleep_.is_asleep(i)) {
      RigidBody& body = solids_.body(i);
      BodyMotion motion = body.motion();
      motion.velocity_W.setZero();
      motion.angular_momentum_W.setZero();
      body.set_motion(motion);
      hulls_.place(solids_, i);
    }
  }
}

}  // namespace tactus::rendering
