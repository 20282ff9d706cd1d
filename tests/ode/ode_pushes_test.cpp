// Bodies that are pushed over the ground and over each other, in BodyWorld and in the Open Dynamics
// Engine.
#include <gtest/gtest.h>

#include <algorithm>

#include "rendering/bodies/finger_grip.h"
#include "tests/ode/twin_worlds.h"

namespace tactus::testing {
namespace {

using rendering::kBodyTick_s;

// Friction makes the front corners carry more, so that the box leaves its straight line. Statics
// leaves open how four corners share the weight, and each engine shares it in its own manner: the
// turn may differ by three percent of the 3.5 rad that the box makes.
TEST(BodiesAndOde, ABoxThatTurnsSlidesOverTheGround) {
  for (const double half_height_m : {0.005, 0.02}) {
    const Vec3 half(0.03, half_height_m, 0.03);
    TwinWorlds worlds({.friction_on_planes = 0.3, .friction_of_bodies = 0.3, .sweeps = 100});
    worlds.add_plane(Vec3::UnitY());
    worlds.add(box_body(half, 0.1, {.translation = {0.0, half_height_m, 0.0}}, {1.0, 0.0, 0.0},
                        {0.0, 20.0, 0.0}));
    expect_alike(half_height_m < 0.01 ? "a low box slides and turns" : "a box slides and turns",
                 worlds, 0.4, {.place_m = 6e-4, .turn_rad = 0.1});
  }
}

// The finger moves evenly and draws the box along by a spring at a point off its middle. The spring
// and the ground's friction damp what differs at the start.
TEST(BodiesAndOde, AFingerPushesABoxOffItsMiddle) {
  constexpr double kSpeed_m_per_s = 0.2;
  const Vec3 half(0.03, 0.005, 0.03);
  const Vec3 held_O(-0.03, 0.0, 0.01);
  TwinWorlds worlds({.friction_on_planes = 0.2, .friction_of_bodies = 0.2, .sweeps = 40});
  worlds.add_plane(Vec3::UnitY());
  const Vec3 center(0.0, 0.005, 0.0);
  worlds.add(box_body(half, 0.1, {.translation = center}, {kSpeed_m_per_s, 0.0, 0.0}));
  Difference most;
  constexpr int kTicks = 400;
  for (int tick = 0; tick < kTicks; ++tick) {
    const Vec3 tool_v(kSpeed_m_per_s, 0.0, 0.0);
    worlds.hold(0, held_O,
                {.stiffness_N_per_m = 50.0,
                 .damping_Ns_per_m = 2.0,
                 .tool_W = center + held_O + kBodyTick_s * tick * tool_v,
                 .tool_v_W = tool_v,
                 .normal_W = -worlds.body(0).motion().rotation_WO.col(0)});
    const Difference now = worlds.difference();
    most.place_m = std::max(most.place_m, now.place_m);
    most.turn_rad = std::max(most.turn_rad, now.turn_rad);
  }
  print_difference("a finger pushes a box off its middle", kTicks * kBodyTick_s, most);
  EXPECT_GT(worlds.body(0).motion().center_W.x(), 0.04) << "it is pushed";
  EXPECT_LT(most.place_m, 5e-5);
  EXPECT_LT(most.turn_rad, 2e-3);
}

// The heavy box slows down and draws the light one along between two frictions; the forces are
// steady but for the start.
TEST(BodiesAndOde, AHeavyBoxSlidesOnALightOne) {
  const Vec3 half(0.03, 0.01, 0.03);
  TwinWorlds worlds({.friction_on_planes = 0.2, .friction_of_bodies = 0.4});
  worlds.add_plane(Vec3::UnitY());
  worlds.add(box_body(half, 0.1, {.translation = {0.0, 0.01, 0.0}}));
  worlds.add(box_body(half, 2.0, {.translation = {0.0, 0.03, 0.0}}, {0.5, 0.0, 0.0}));
  expect_alike("a heavy box slides on a light one", worlds, 0.3,
               {.place_m = 1e-4, .turn_rad = 1e-3});
}

}  // namespace
}  // namespace tactus::testing
