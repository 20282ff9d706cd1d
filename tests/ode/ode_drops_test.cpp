// Drops and free tumbling, in BodyWorld and in the Open Dynamics Engine.
//
// A hit of BodyWorld happens at the end of a sub-step of 0.25 ms and begins within it. At the
// speeds of these drops, 0.9 m/s and 25 rad/s after the hit, that makes up to 0.23 mm and 6.3 mrad.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/ode/twin_worlds.h"

namespace tactus::testing {
namespace {

using rendering::body_turned;
using rendering::kBodyGravity_m_per_s2;
using rendering::kBodyTick_s;
using rendering::PrimitiveKind;

constexpr Difference kHitLimit{.place_m = 2.3e-4, .turn_rad = 6.3e-3};
constexpr double kDrop_s = 0.5;

std::string drop_of(const std::string& body, double friction) {
  return body + ", friction " + std::to_string(friction).substr(0, 3);
}

// The midpoint rule of BodyWorld lags by (w h)^2 / 12 or so of the angle: 11 rad/s for a second and
// steps of 0.25 ms make some microradians; ODE's rule of first order has steps of 20 us: 11 rad
// times 11 rad/s times 10 us is 1.2 mrad, as far as its errors do not cancel. The limit is double.
TEST(BodiesAndOde, ABoxWithoutGravityTumbles) {
  TwinWorlds worlds({.gravity_W = Vec3::Zero()});
  worlds.add(box_body({0.03, 0.02, 0.01}, 0.1, {}, {0.1, 0.0, 0.0}, {6.0, 2.0, 9.0}));
  expect_alike("a free box tumbles", worlds, 1.0, {.place_m = 1e-9, .turn_rad = 2.4e-3});
}

// A ball falls for 0.128 s, ahead by the step, and then lies still.
TEST(BodiesAndOde, ABallFallsAndStays) {
  TwinWorlds worlds({});
  worlds.add_plane(Vec3::UnitY());
  worlds.add(ball_body(0.02, 0.1, {0.0, 0.1, 0.0}));
  expect_alike("a ball falls", worlds, 0.3,
               {.place_m = ahead_m(kBodyGravity_m_per_s2, 0.128) + 1e-5, .turn_rad = 1e-9});
  EXPECT_LT(worlds.difference().place_m, 1e-5) << "at rest";
}

// BodyWorld bounces at the end of a tick, late by at most 1 ms, and as late again as the bounce
// before it. Until the later engine has bounced, the two part with the speeds before and after.
TEST(BodiesAndOde, ABallBounces) {
  for (const double restitution : {0.5, 0.8}) {
    TwinWorlds worlds({.restitution = restitution});
    worlds.add_plane(Vec3::UnitY());
    worlds.add(ball_body(0.02, 0.1, {0.0, 0.1, 0.0}));
    double limit_m = 0.0;
    double speed = std::sqrt(2.0 * kBodyGravity_m_per_s2 * 0.08);
    for (const double bounce : {1.0, 2.0, 3.0}) {
      limit_m = std::max(limit_m, bounce * kBodyTick_s * (1.0 + restitution) * speed);
      speed *= restitution;
    }
    expect_alike("a ball bounces, restitution " + std::to_string(restitution).substr(0, 3), worlds,
                 kDrop_s, {.place_m = limit_m, .turn_rad = 1e-9});
  }
}

TEST(BodiesAndOde, ABoxFallsOnAnEdgeAndThenOnAFace) {
  for (const double friction : {0.0, 0.3, 0.6}) {
    TwinWorlds worlds({.friction_on_planes = friction,
                       .friction_of_bodies = friction,
                       .sweeps = friction > 0.0 ? 40 : 0});
    worlds.add_plane(Vec3::UnitY());
    worlds.add(box_body({0.03, 0.02, 0.01}, 0.1,
                        {.rotation = body_turned(Vec3::UnitZ(), friction > 0.0 ? 0.8 : 0.4),
                         .translation = {0.0, 0.06, 0.0}}));
    expect_alike(drop_of("a box falls on an edge", friction), worlds, kDrop_s, kHitLimit);
  }
}

// With friction the slip of a corner turns in the hit, which the pyramid of ODE cannot follow.
TEST(BodiesAndOde, ABoxFallsOnACorner) {
  TwinWorlds worlds({});
  worlds.add_plane(Vec3::UnitY());
  worlds.add(box_body(
      {0.03, 0.02, 0.01}, 0.1,
      {.rotation = body_turned(Vec3(1.0, 0.3, 0.7), 0.7), .translation = {0.0, 0.06, 0.0}}));
  expect_alike(drop_of("a box falls on a corner", 0.0), worlds, kDrop_s, kHitLimit);
}

TEST(BodiesAndOde, ACapsuleFallsOnOneEndAndThenOnTheOther) {
  for (const double friction : {0.0, 0.5}) {
    TwinWorlds worlds({.friction_on_planes = friction,
                       .friction_of_bodies = friction,
                       .sweeps = friction > 0.0 ? 40 : 0});
    worlds.add_plane(Vec3::UnitY());
    worlds.add(
        round_body(PrimitiveKind::capsule, 0.01, 0.03, 0.05,
                   {.rotation = body_turned(Vec3::UnitZ(), 1.0), .translation = {0.0, 0.06, 0.0}}));
    expect_alike(drop_of("a capsule falls on an end", friction), worlds, kDrop_s, kHitLimit);
  }
}

}  // namespace
}  // namespace tactus::testing
