// Bodies that slide and roll down slopes, in BodyWorld and in the Open Dynamics Engine.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/ode/twin_worlds.h"

namespace tactus::testing {
namespace {

using rendering::body_turned;
using rendering::kBodyGravity_m_per_s2;
using rendering::PrimitiveKind;

constexpr double kSlide_s = 0.5;
constexpr double kRadius_m = 0.02;

// The ground is level and gravity leans.
TwinWorlds::Setting slope(double angle_rad, double friction) {
  return {.gravity_W = kBodyGravity_m_per_s2 * Vec3(std::sin(angle_rad), -std::cos(angle_rad), 0.0),
          .friction_on_planes = friction,
          .friction_of_bodies = friction};
}

std::string slide_of(const std::string& body, double friction) {
  return body + ", friction " + std::to_string(friction).substr(0, 3);
}

// Both engines have the acceleration of Coulomb's law; a hundredth of a millimetre more is what the
// soft contact of BodyWorld sinks in at the start.
TEST(BodiesAndOde, ABoxSlidesDownASlope) {
  constexpr double kSlope_rad = 0.6;
  for (const double friction : {0.1, 0.3, 0.5, 0.8}) {
    TwinWorlds worlds(slope(kSlope_rad, friction));
    worlds.add_plane(Vec3::UnitY());
    worlds.add(box_body({0.03, 0.02, 0.01}, 0.1, {.translation = {0.0, 0.02, 0.0}}));
    const double acceleration =
        std::max(std::sin(kSlope_rad) - friction * std::cos(kSlope_rad), 0.0) *
        kBodyGravity_m_per_s2;
    expect_alike(slide_of("a box on a slope of 0.6 rad", friction), worlds, kSlide_s,
                 {.place_m = ahead_m(acceleration, kSlide_s) + 1e-5, .turn_rad = 1e-5});
  }
}

// With little friction the ball slips and rolls at once. It sinks in by 20 um, a thousandth of its
// radius, which changes its turn by as much.
TEST(BodiesAndOde, ABallRollsDownASlope) {
  constexpr double kSlope_rad = 0.5;
  for (const double friction : {0.1, 0.5}) {
    TwinWorlds worlds(slope(kSlope_rad, friction));
    worlds.add_plane(Vec3::UnitY());
    worlds.add(ball_body(kRadius_m, 0.1, {0.0, kRadius_m, 0.0}));
    const double acceleration = std::max(std::sin(kSlope_rad) - friction * std::cos(kSlope_rad),
                                         5.0 / 7.0 * std::sin(kSlope_rad)) *
                                kBodyGravity_m_per_s2;
    const double limit_m = ahead_m(acceleration, kSlide_s) + 2.5e-5;
    expect_alike(slide_of("a ball on a slope of 0.5 rad", friction), worlds, kSlide_s,
                 {.place_m = limit_m, .turn_rad = limit_m / kRadius_m});
  }
}

TEST(BodiesAndOde, ACylinderRollsDownASlope) {
  constexpr double kSlope_rad = 0.3;
  TwinWorlds worlds(slope(kSlope_rad, 0.5));
  worlds.add_plane(Vec3::UnitY());
  worlds.add(round_body(PrimitiveKind::cylinder, kRadius_m, 0.03, 0.1,
                        {.rotation = body_turned(Vec3::UnitX(), 0.5 * std::numbers::pi),
                         .translation = {0.0, kRadius_m, 0.0}}));
  const double acceleration = 2.0 / 3.0 * std::sin(kSlope_rad) * kBodyGravity_m_per_s2;
  const double limit_m = ahead_m(acceleration, kSlide_s) + 2.5e-5;
  expect_alike(slide_of("a cylinder on a slope of 0.3 rad", 0.5), worlds, kSlide_s,
               {.place_m = limit_m, .turn_rad = limit_m / kRadius_m});
}

}  // namespace
}  // namespace tactus::testing
