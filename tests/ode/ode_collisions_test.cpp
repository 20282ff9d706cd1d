// Bodies that meet in flight, in BodyWorld and in the Open Dynamics Engine.
//
// BodyWorld finds contacts once a tick, up to 1 ms before the bodies meet, and bounces at its end.
#include <gtest/gtest.h>

#include <string>

#include "tests/ode/twin_worlds.h"

namespace tactus::testing {
namespace {

using rendering::body_turned;

constexpr double kFlight_s = 0.2;
const Vec3 kBrickHalf_m(0.03, 0.02, 0.01);

std::string meeting_of(const std::string& bodies, double restitution) {
  return bodies + ", restitution " + std::to_string(restitution).substr(0, 3);
}
TwinWorlds::Setting flight(double restitution) {
  return {.gravity_W = Vec3::Zero(), .restitution = restitution};
}

// Head-on, the bounce is late by a tick at most: 1.5 m/s for 1 ms.
TEST(BodiesAndOde, BallsMeetHeadOn) {
  TwinWorlds worlds(flight(0.5));
  worlds.add(ball_body(0.02, 0.1, Vec3::Zero(), {1.0, 0.0, 0.0}));
  worlds.add(ball_body(0.02, 0.05, {0.0607, 0.0, 0.0}, {-0.5, 0.0, 0.0}));
  expect_alike(meeting_of("balls meet head-on", 0.5), worlds, kFlight_s,
               {.place_m = 1.5e-3, .turn_rad = 1e-9});
}

// The normal is that of the beginning of the tick, when the balls are up to 1.5 mm away from each
// other across 40 mm: it is off by up to 15 mrad (sine 0.375 at the meeting), so that the speeds of
// about 0.5 m/s after it are off by 8 mm/s, 1.5 mm after the flight.
TEST(BodiesAndOde, BallsMeetOffTheirCentres) {
  for (const double restitution : {0.0, 0.5}) {
    TwinWorlds worlds(flight(restitution));
    worlds.add(ball_body(0.02, 0.1, Vec3::Zero(), {1.0, 0.0, 0.0}));
    worlds.add(ball_body(0.02, 0.05, {0.06, 0.015, 0.0}, {-0.5, 0.0, 0.0}));
    expect_alike(meeting_of("balls meet off their centres", restitution), worlds, kFlight_s,
                 {.place_m = 1.5e-3, .turn_rad = 1e-9});
  }
}

// A bounce that is late by up to 1 ms lets the boxes go on with up to 1.5 m/s and turn later, with
// 15 rad/s.
TEST(BodiesAndOde, FacesMeetOffTheirCentres) {
  for (const double restitution : {0.0, 0.5}) {
    TwinWorlds worlds(flight(restitution));
    worlds.add(box_body(kBrickHalf_m, 0.1, {}, {1.0, 0.0, 0.0}));
    worlds.add(box_body(kBrickHalf_m, 0.05, {.translation = {0.08, 0.015, 0.0}}, {-0.5, 0.0, 0.0}));
    expect_alike(meeting_of("faces meet off their centres", restitution), worlds, kFlight_s,
                 {.place_m = 1e-3, .turn_rad = 15e-3});
  }
}

// Without restitution they meet once more, edge to face, while the angle between them turns.
TEST(BodiesAndOde, AnEdgeMeetsAFace) {
  TwinWorlds worlds(flight(0.5));
  worlds.add(
      box_body(kBrickHalf_m, 0.1, {.rotation = body_turned(Vec3::UnitZ(), 0.5)}, {1.0, 0.0, 0.0}));
  worlds.add(box_body(kBrickHalf_m, 0.05, {.translation = {0.08, 0.012, 0.0}}, {-0.5, 0.0, 0.0}));
  expect_alike(meeting_of("an edge meets a face", 0.5), worlds, kFlight_s,
               {.place_m = 1e-3, .turn_rad = 15e-3});
}

}  // namespace
}  // namespace tactus::testing
