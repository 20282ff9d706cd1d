// Bodies on triangle meshes, against the same scene with a primitive and against closed forms.
#include "rendering/bodies/mesh_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/share.h"
#include "tests/unit/rendering/bodies/body_bench.h"

namespace tactus::rendering {
namespace {

using testing::part_of;
using testing::Shape;

Shape at(Shape shape, const Vec3& place) {
  for (Float3& v : shape.vertices) {
    v = to_float3(to_vec3(v) + place);
  }
  return shape;
}

// A box whose middle is at the origin.
Shape centred_box(const Vec3& size) {
  Shape shape = testing::box(size);
  double lowest = 1.0;
  double highest = -1.0;
  for (const Float3& v : shape.vertices) {
    lowest = std::min(lowest, static_cast<double>(v.z));
    highest = std::max(highest, static_cast<double>(v.z));
  }
  return at(std::move(shape), Vec3(0.0, 0.0, -0.5 * (lowest + highest)));
}

// Two worlds that differ in an obstacle alone.
struct Twins {
  BodyBench mesh;
  BodyBench primitive;

  void set_gravity(const Vec3& gravity) {
    mesh.world().set_gravity(gravity);
    primitive.world().set_gravity(gravity);
  }
  void add_box(const Vec3& half, double mass_kg, const RigidPose& pose, double friction,
               const Vec3& velocity = Vec3::Zero()) {
    mesh.add_box(half, mass_kg, pose, friction, velocity);
    primitive.add_box(half, mass_kg, pose, friction, velocity);
  }
  void add_ball(double radius, const Vec3& center, const ContactSurface& surface,
                const Vec3& velocity) {
    mesh.add_ball(radius, 0.05, center, surface, velocity);
    primitive.add_ball(radius, 0.05, center, surface, velocity);
  }
  // Runs both, and returns the largest distance between their bodies' centres at any time.
  double run(double seconds) {
    double most = 0.0;
    for (int i = 0; i < part_of(static_cast<int>(std::lround(seconds / kBodyTick_s))); ++i) {
      mesh.run(kBodyTick_s);
      primitive.run(kBodyTick_s);
      for (std::size_t b = 0; b < mesh.world().bodies().size(); ++b) {
        most = std::max(
            most, (mesh.body(b).motion().center_W - primitive.body(b).motion().center_W).norm());
      }
    }
    return most;
  }
};

Vec3 gravity_on_slope(double angle) {
  return kBodyGravity_m_per_s2 * Vec3(std::sin(angle), -std::cos(angle), 0.0);
}

TEST(MeshContact, ABallMovesOverTrianglesAsOverAPlane) {
  for (const Vec3& velocity : {Vec3(0.3, 0.0, 0.17), Vec3(-0.2, -0.5, 0.0), Vec3(0.0, 0.0, 0.4)}) {
    Twins twins;
    twins.mesh.add_mesh(testing::flat_sheet(0.005, 160), 0.3);
    twins.primitive.add_plane(Vec3::UnitY(), 0.3);
    twins.add_ball(0.02, Vec3(0.0, 0.0205, 0.0), {.friction = 0.3, .restitution = 0.4}, velocity);
    EXPECT_LT(twins.run(1.0), 1e-9);
  }
}

TEST(MeshContact, ABoxMovesOverTrianglesAsOverAPlane) {
  for (const double cell : {0.003, 0.011, 0.05}) {
    Twins twins;
    const auto cells = static_cast<int>(0.8 / cell);
    twins.mesh.add_mesh(testing::flat_sheet(cell, cells + cells % 2), 0.3);
    twins.primitive.add_plane(Vec3::UnitY(), 0.3);
    twins.add_box(Vec3(0.02, 0.01, 0.015), 0.1,
                  {.rotation = body_turned(Vec3::UnitY(), 0.4), .translation = {0.0, 0.01, 0.0}},
                  0.3, Vec3(0.9, 0.0, 0.5));
    twins.add_box(
        Vec3(0.02, 0.01, 0.015), 0.1,
        {.rotation = body_turned(Vec3(0.2, 1.0, -0.4), 0.6), .translation = {0.0, 0.06, 0.1}}, 0.3,
        Vec3(0.4, 0.0, -0.3));
    EXPECT_LT(twins.run(1.0), 1e-6) << cell;
  }
}

TEST(MeshContact, ABallRollsDownASlopeWithFiveSevenths) {
  constexpr double kAngle = 0.3;
  BodyBench bench;
  bench.world().set_gravity(gravity_on_slope(kAngle));
  bench.add_mesh(testing::flat_sheet(0.01, 400), 0.6);
  bench.add_ball(0.02, 0.05, Vec3(0.0, 0.02, 0.003), {.friction = 0.6});
  bench.run(1.0);
  const double expected = 5.0 / 7.0 * kBodyGravity_m_per_s2 * std::sin(kAngle);
  EXPECT_NEAR(bench.body(0).motion().velocity_W.x(), expected, 0.005 * expected);
  EXPECT_NEAR(bench.body(0).motion().velocity_W.z(), 0.0, 1e-9) << "no edge turns it aside";
}

TEST(MeshContact, ABoxSlidesDownASlopeBeyondTheAngleOfFriction) {
  constexpr double kFriction = 0.5;
  for (const double factor : {0.99, 1.2}) {
    const double angle = std::atan(kFriction) * factor;
    BodyBench bench;
    bench.world().set_gravity(gravity_on_slope(angle));
    bench.add_mesh(testing::flat_sheet(0.007, 300), kFriction);
    bench.add_box(Vec3(0.02, 0.005, 0.02), 0.1, {.translation = {0.0, 0.005, 0.0}}, kFriction);
    bench.run(0.1);
    const double speed = bench.body(0).motion().velocity_W.x();
    bench.run(0.5);
    const double expected = std::max(
        0.0, kBodyGravity_m_per_s2 * (std::sin(angle) - kFriction * std::cos(angle)) * 0.5);
    EXPECT_NEAR(bench.body(0).motion().velocity_W.x() - speed, expected, 0.005 * expected + 1e-5);
  }
}

// The mesh's edges lie under the box's face where it juts out.
TEST(MeshContact, ABoxOnABlockMovesAsOnABox) {
  const Vec3 block(0.06, 0.04, 0.05);
  for (const Vec3& offset : {Vec3(0.0, 0.0, 0.0), Vec3(0.022, 0.0, 0.013), Vec3(0.045, 0.0, 0.0)}) {
    for (const double half : {0.015, 0.05}) {
      Twins twins;
      twins.mesh.add_mesh(centred_box(block), 0.4);
      PrimitiveHull hull;
      hull.make({.kind = PrimitiveKind::box,
                 .dimensions_m = {0.5 * block.x(), 0.5 * block.y(), 0.5 * block.z()}});
      ASSERT_TRUE(twins.primitive.world().add_obstacle(
          {.hull = hull.hull(), .surface = {.friction = 0.4}}));
      twins.add_box(Vec3(half, 0.01, half), 0.1,
                    {.rotation = body_turned(Vec3::UnitY(), 0.3),
                     .translation = offset + Vec3(0.0, 0.03, 0.0)},
                    0.4);
      EXPECT_LT(twins.run(offset.x() > 0.04 ? 0.15 : 1.0), 2e-4) << offset.transpose() << half;
    }
  }
}

// A ball in a groove of 90 degrees touches both sides; its middle is root 2 radii above the edge.
TEST(MeshContact, ABallRestsInAGroove) {
  Shape groove = testing::flat_sheet(0.02, 20);
  for (Float3& v : groove.vertices) {
    v.y = std::abs(v.x);
  }
  BodyBench bench;
  bench.add_mesh(std::move(groove), 0.3);
  bench.add_ball(0.01, 0.05, Vec3(0.003, 0.022, 0.001), {.friction = 0.3});
  bench.run(3.0);
  const Vec3 center = bench.body(0).motion().center_W;
  EXPECT_NEAR(center.y(), std::numbers::sqrt2 * 0.01, 2e-5);
  EXPECT_NEAR(center.x(), 0.0, 2e-5);
  EXPECT_LT(bench.body(0).motion().velocity_W.norm(), 1e-6);
}

// A slab upon a ridge touches its edge; it lies still where its middle is over the edge.
TEST(MeshContact, ASlabBalancesOnARidge) {
  Shape ridge = testing::flat_sheet(0.02, 10);
  for (Float3& v : ridge.vertices) {
    v.y = -std::abs(v.x);
  }
  BodyBench bench;
  bench.add_mesh(std::move(ridge), 0.5);
  bench.add_box(Vec3(0.03, 0.005, 0.03), 0.1, {.translation = {0.0, 0.005, 0.0}}, 0.5);
  bench.run(0.2);
  EXPECT_NEAR(bench.body(0).motion().center_W.y(), 0.005, 2e-5);
  EXPECT_GT(bench.body(0).motion().rotation_WO(1, 1), 0.9999);
}

TEST(MeshContact, ASheetOfTwoSidesStopsFromBelowAndOneOfOneSideDoesNot) {
  for (const Sides sides : {Sides::one, Sides::two}) {
    BodyBench bench;
    bench.world().set_gravity(Vec3(0.0, kBodyGravity_m_per_s2, 0.0));
    bench.add_mesh(testing::flat_sheet(0.01, 20), 0.5, sides);
    bench.add_box(Vec3(0.02, 0.01, 0.02), 0.1, {.translation = {0.0, -0.03, 0.0}}, 0.5);
    bench.run(0.5);
    if (sides == Sides::two) {
      EXPECT_NEAR(bench.body(0).motion().center_W.y(), -0.01, 1e-4);
    } else {
      EXPECT_GT(bench.body(0).motion().center_W.y(), 0.1);
    }
  }
}

TEST(MeshContact, NothingGoesThroughAMeshHoweverFast) {
  for (const double speed : {1.0, 5.0, 20.0}) {
    for (const bool is_ball : {true, false}) {
      BodyBench bench;
      bench.add_mesh(testing::flat_sheet(0.02, 100), 0.3);
      const Vec3 velocity(0.0, -speed, 0.0);
      if (is_ball) {
        bench.add_ball(0.005, 0.01, Vec3(0.0, 0.1, 0.0), {.friction = 0.3}, velocity);
      } else {
        bench.add_box(
            Vec3(0.01, 0.005, 0.01), 0.01,
            {.rotation = body_turned(Vec3(1.0, 0.4, 0.2), 0.5), .translation = {0.0, 0.1, 0.0}},
            0.3, velocity);
      }
      double lowest = 1.0;
      for (int i = 0; i < 300; ++i) {
        bench.run(kBodyTick_s);
        lowest = std::min(lowest, bench.body(0).motion().center_W.y());
      }
      // A box that meets it with a corner comes in by a part of its height, as into a plane.
      EXPECT_GT(lowest, is_ball || speed < 10.0 ? 0.005 - 5e-4 : 0.0) << speed << is_ball;
    }
  }
}

// An obstacle that moves by itself carries the body that stands on it.
TEST(MeshContact, ABoxRidesOnAMeshThatMovesAsOnABoxThatMoves) {
  const Vec3 block(0.2, 0.04, 0.2);
  Twins twins;
  twins.mesh.add_mesh(centred_box(block), 0.6);
  PrimitiveHull hull;
  hull.make({.kind = PrimitiveKind::box, .dimensions_m = {0.1, 0.02, 0.1}});
  ASSERT_TRUE(
      twins.primitive.world().add_obstacle({.hull = hull.hull(), .surface = {.friction = 0.6}}));
  twins.add_box(Vec3(0.02, 0.02, 0.02), 0.1, {.translation = {0.03, 0.04, 0.02}}, 0.6);
  double most = 0.0;
  for (int i = 0; i < 1500; ++i) {
    const double t = kBodyTick_s * i;
    const double turn = 0.2 * std::sin(4.0 * t);
    const RigidPose pose{.rotation = body_turned(Vec3::UnitY(), turn),
                         .translation = {0.05 * std::sin(3.0 * t), 0.02 * std::sin(5.0 * t), 0.0}};
    const Twist twist{.linear_W = {0.15 * std::cos(3.0 * t), 0.1 * std::cos(5.0 * t), 0.0},
                      .angular_W = 0.8 * std::cos(4.0 * t) * Vec3::UnitY()};
    twins.mesh.world().set_obstacle(0, pose, twist);
    twins.primitive.world().set_obstacle(0, pose, twist);
    most = std::max(most, twins.run(kBodyTick_s));
  }
  EXPECT_LT(most, 2e-5);
  EXPECT_GT(twins.mesh.body(0).motion().center_W.y(), 0.01) << "it is still on it";
}

// Polyhedra bound the motion on a ball of many triangles from both sides: the rest height is
// between those of the inscribed and the circumscribed ball, and nothing gains energy.
TEST(MeshContact, BodiesOnARoughMeshGainNoEnergyAndStayOutside) {
  for (int seed = 0; seed < part_of(12); ++seed) {
    BodyBench bench;
    bench.add_mesh(testing::height_field(0.3, 60, 0.004), 0.3, Sides::two);
    const int row = seed / 4;
    const Vec3 start(0.01 * (seed % 4) - 0.015, 0.035, 0.007 * row - 0.01);
    const Mat3 turned = body_turned(Vec3(1.0, 0.3 * seed, 0.7), 0.5 * seed);
    if (seed % 3 == 0) {
      bench.add_ball(0.008, 0.05, start, {.friction = 0.3}, Vec3(0.1, 0.0, 0.05));
    } else {
      bench.add_box(Vec3(0.015, 0.008, 0.01), 0.1, {.rotation = turned, .translation = start}, 0.3,
                    Vec3(0.1, 0.0, 0.05));
    }
    const auto energy_J = [&] {
      const RigidBody& body = bench.body(0);
      return body.kinetic_energy_J() +
             body.mass().mass_kg * kBodyGravity_m_per_s2 * body.motion().center_W.y();
    };
    double least_J = energy_J();
    for (int i = 0; i < 1500; ++i) {
      bench.run(kBodyTick_s);
      // Soft recovery lifts a body by some micrometres.
      ASSERT_LT(energy_J(), least_J + 1e-5) << seed << ' ' << i;
      least_J = std::min(least_J, energy_J());
      ASSERT_GT(bench.body(0).motion().center_W.y(), 0.0) << seed << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
