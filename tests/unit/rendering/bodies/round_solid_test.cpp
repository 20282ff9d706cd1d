// Cylinders and cones, as bodies and as obstacles, against closed forms and exact distances.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "rendering/bodies/manifold.h"
#include "rendering/surface/primitive.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/bodies/body_bench.h"

namespace tactus::rendering {
namespace {

using testing::share_of;

constexpr double kRound_m = 0.02;
constexpr double kHalfLength_m = 0.03;

Primitive cylinder() {
  return {.kind = PrimitiveKind::cylinder, .dimensions_m = {kRound_m, kHalfLength_m}};
}
Primitive cone() {
  return {.kind = PrimitiveKind::cone, .dimensions_m = {kRound_m, 2.0 * kHalfLength_m}};
}

BodyMass mass_of_cylinder(double mass_kg) {
  const double across = mass_kg * (kRound_m * kRound_m / 4.0 + kHalfLength_m * kHalfLength_m / 3.0);
  return {.mass_kg = mass_kg,
          .inertia_C = Vec3(across, 0.5 * mass_kg * kRound_m * kRound_m, across).asDiagonal()};
}

// The centre of mass is a quarter of the height above the base.
BodyMass mass_of_cone(double mass_kg) {
  const double height = 2.0 * kHalfLength_m;
  const double across = mass_kg * (3.0 / 20.0 * kRound_m * kRound_m + 3.0 / 80.0 * height * height);
  return {.mass_kg = mass_kg,
          .center_O = Vec3(0.0, 0.25 * height, 0.0),
          .inertia_C = Vec3(across, 0.3 * mass_kg * kRound_m * kRound_m, across).asDiagonal()};
}

enum class Floor { plane, mesh, box };

void add_floor(BodyBench& bench, PrimitiveHull& hull, Floor floor, double friction) {
  if (floor == Floor::plane) {
    bench.add_plane(Vec3::UnitY(), friction);
  } else if (floor == Floor::mesh) {
    bench.add_mesh(testing::flat_sheet(0.013, 300), friction);
  } else {
    hull.make({.kind = PrimitiveKind::box,
               .X_WO = {.translation = {0.0, -0.5, 0.0}},
               .dimensions_m = {2.0, 0.5, 2.0}});
    ASSERT_TRUE(
        bench.world().add_obstacle({.hull = hull.hull(), .surface = {.friction = friction}}));
  }
}

TEST(RoundSolid, ACylinderRollsDownASlopeWithTwoThirds) {
  constexpr double kAngle = 0.3;
  for (const Floor floor : {Floor::plane, Floor::mesh, Floor::box}) {
    BodyBench bench;
    PrimitiveHull hull;
    bench.world().set_gravity(kBodyGravity_m_per_s2 *
                              Vec3(std::sin(kAngle), -std::cos(kAngle), 0.0));
    add_floor(bench, hull, floor, 0.6);
    bench.add(cylinder(), mass_of_cylinder(0.1),
              {.rotation = body_turned(Vec3::UnitX(), 0.5 * std::numbers::pi),
               .translation = {0.0, kRound_m, 0.004}},
              {.friction = 0.6});
    bench.run(0.8);
    const double expected = 2.0 / 3.0 * kBodyGravity_m_per_s2 * std::sin(kAngle) * 0.8;
    EXPECT_NEAR(bench.body(0).motion().velocity_W.x(), expected, 0.005 * expected)
        << static_cast<int>(floor);
    EXPECT_NEAR(bench.body(0).motion().center_W.y(), kRound_m, 2e-5);
  }
}

TEST(RoundSolid, ACylinderAndAConeStandOnTheirBases) {
  for (const Floor floor : {Floor::plane, Floor::mesh, Floor::box}) {
    for (const bool is_cone : {false, true}) {
      BodyBench bench;
      PrimitiveHull hull;
      add_floor(bench, hull, floor, 0.5);
      const double base_m = is_cone ? 0.0 : kHalfLength_m;
      bench.add(is_cone ? cone() : cylinder(), is_cone ? mass_of_cone(0.1) : mass_of_cylinder(0.1),
                {.translation = {0.005, base_m + 0.001, 0.003}}, {.friction = 0.5});
      bench.run(1.0);
      EXPECT_NEAR(bench.body(0).pose().translation.y(), base_m, 2e-5);
      EXPECT_GT(bench.body(0).motion().rotation_WO(1, 1), 1.0 - 1e-6);
      EXPECT_LT(bench.body(0).motion().velocity_W.norm(), 1e-5) << static_cast<int>(floor);
    }
  }
}

// A cone that lies on its side rolls about its tip and does not sink in.
TEST(RoundSolid, AConeLiesOnItsSide) {
  const double lean = std::atan2(kRound_m, 2.0 * kHalfLength_m);
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), 0.5);
  // The axis is level first; then the tip goes down.
  bench.add(cone(), mass_of_cone(0.1),
            {.rotation = body_turned(Vec3::UnitZ(), -0.5 * std::numbers::pi - lean),
             .translation = {0.0, kRound_m * std::cos(lean), 0.0}},
            {.friction = 0.5});
  bench.run(1.0);
  const RigidPose pose = bench.body(0).pose();
  EXPECT_NEAR(pose.translation.y(), kRound_m * std::cos(lean), 5e-5);
  EXPECT_NEAR(pose.point(2.0 * kHalfLength_m * Vec3::UnitY()).y(), 0.0, 5e-5);
}

// The hull differs from the solid by less than half a percent of the radius.
TEST(RoundSolid, TheHullIsAsNearAsIsSaid) {
  std::mt19937_64 random(20261127);
  const auto number = [&](double size) {
    return std::uniform_real_distribution<double>(-size, size)(random);
  };
  for (const Primitive& solid : {cylinder(), cone()}) {
    PrimitiveHull hull;
    hull.make(solid);
    PlacedHull placed;
    placed.place(hull.hull(), {});
    for (int i = 0; i < share_of(3000); ++i) {
      const Vec3 p(number(0.06), number(0.1), number(0.06));
      const double exact = sample(solid, p).distance_m;
      if (exact < 0.001) {
        continue;
      }
      PrimitiveHull point;
      point.make(
          {.kind = PrimitiveKind::sphere, .X_WO = {.translation = p}, .dimensions_m = {1e-4}});
      PlacedHull ball;
      ball.place(point.hull(), {});
      const Manifold manifold = manifold_of(placed, ball, 1.0);
      ASSERT_EQ(manifold.count, 1U);
      ASSERT_NEAR(manifold.points[0].separation_m + 1e-4, exact, 0.0045 * kRound_m)
          << p.transpose();
    }
  }
}

// A slab of ice on a post, and a ball beside a cone: what they touch is the obstacle's own surface.
TEST(RoundSolid, ASlabRestsOnAPost) {
  BodyBench bench;
  PrimitiveHull post;
  post.make(cylinder());
  ASSERT_TRUE(bench.world().add_obstacle({.hull = post.hull(), .surface = {.friction = 0.4}}));
  bench.add_box(Vec3(0.04, 0.005, 0.03), 0.1,
                {.rotation = body_turned(Vec3::UnitY(), 0.3),
                 .translation = {0.004, kHalfLength_m + 0.006, 0.002}},
                0.4);
  bench.run(1.0);
  EXPECT_NEAR(bench.body(0).motion().center_W.y(), kHalfLength_m + 0.005, 2e-5);
  EXPECT_LT(bench.body(0).motion().velocity_W.norm(), 1e-5);
}

}  // namespace
}  // namespace tactus::rendering
