// Bodies on tori and formulas, against primitives of the same shape and closed forms.
#include "rendering/bodies/field_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/unit/rendering/bodies/body_bench.h"

namespace tactus::rendering {
namespace {

// y = 0, with the solid below; in decimetres, so that the scale counts.
constexpr std::array kGround{Instruction{.opcode = Opcode::y}};
constexpr double kFieldBall_m = 0.05;
// x^2 + y^2 + z^2 - 1, with the ball's radius for a unit.
constexpr std::array kUnitBall{Instruction{.opcode = Opcode::x},
                               Instruction{.opcode = Opcode::y},
                               Instruction{.opcode = Opcode::z},
                               Instruction{.opcode = Opcode::power, .a = 0, .exponent = 2},
                               Instruction{.opcode = Opcode::power, .a = 1, .exponent = 2},
                               Instruction{.opcode = Opcode::power, .a = 2, .exponent = 2},
                               Instruction{.opcode = Opcode::add, .a = 3, .b = 4},
                               Instruction{.opcode = Opcode::add, .a = 6, .b = 5},
                               Instruction{.opcode = Opcode::offset, .a = 7, .constant = -1.0}};

ImplicitSurface flat_formula() {
  return {.formula = {kGround},
          .bounds_O = {.lower = Vec3::Constant(-20.0), .upper = Vec3::Constant(20.0)},
          .scale_m = 0.1};
}
ImplicitSurface ball() {
  return {.formula = {kUnitBall},
          .bounds_O = {.lower = Vec3::Constant(-3.0), .upper = Vec3::Constant(3.0)},
          .scale_m = kFieldBall_m};
}

void add_field(BodyBench& bench, const ObstacleField& field, double friction) {
  ASSERT_TRUE(bench.world().add_obstacle({.field = field, .surface = {.friction = friction}}));
}

double largest_difference(BodyBench& a, BodyBench& b, double seconds) {
  double most = 0.0;
  for (int i = 0; i < static_cast<int>(std::lround(seconds / kBodyTick_s)); ++i) {
    a.run(kBodyTick_s);
    b.run(kBodyTick_s);
    most = std::max(most, (a.body(0).motion().center_W - b.body(0).motion().center_W).norm());
  }
  return most;
}

TEST(FieldContact, BodiesMoveOnALevelFormulaAsOnAPlane) {
  const ImplicitSurface surface = flat_formula();
  for (const bool is_ball : {true, false}) {
    BodyBench field;
    BodyBench plane;
    add_field(field, {.implicit = &surface}, 0.3);
    plane.add_plane(Vec3::UnitY(), 0.3);
    for (BodyBench* bench : {&field, &plane}) {
      if (is_ball) {
        bench->add_ball(0.02, 0.05, Vec3(0.0, 0.03, 0.0), {.friction = 0.3}, Vec3(0.3, 0.0, 0.1));
      } else {
        bench->add_box(Vec3(0.02, 0.01, 0.015), 0.1,
                       {.rotation = body_turned(Vec3::UnitY(), 0.4), .translation = {0, 0.01, 0}},
                       0.3, Vec3(0.5, 0.0, 0.2));
      }
    }
    EXPECT_LT(largest_difference(field, plane, 1.0), is_ball ? 1e-9 : 1e-6);
  }
}

TEST(FieldContact, ABallRollsOffABallOfAFormulaAsOffABall) {
  const ImplicitSurface surface = ball();
  PrimitiveHull hull;
  hull.make({.kind = PrimitiveKind::sphere, .dimensions_m = {kFieldBall_m}});
  BodyBench field;
  BodyBench sphere;
  add_field(field, {.implicit = &surface}, 0.4);
  ASSERT_TRUE(sphere.world().add_obstacle({.hull = hull.hull(), .surface = {.friction = 0.4}}));
  for (BodyBench* bench : {&field, &sphere}) {
    bench->add_ball(0.02, 0.05, (kFieldBall_m + 0.02) * Vec3(0.1, 1.0, 0.05).normalized(),
                    {.friction = 0.4});
  }
  EXPECT_LT(largest_difference(field, sphere, 0.4), 2e-5);
}

// A box that stands on the ball touches it with its face alone.
TEST(FieldContact, AFaceRestsOnAFormula) {
  const ImplicitSurface surface = ball();
  BodyBench bench;
  add_field(bench, {.implicit = &surface}, 0.5);
  bench.add_box(Vec3(0.03, 0.005, 0.03), 0.1, {.translation = {0.0, kFieldBall_m + 0.006, 0.0}},
                0.5);
  bench.run(0.5);
  EXPECT_NEAR(bench.body(0).motion().center_W.y(), kFieldBall_m + 0.005, 2e-5);
}

// A ball in the hole of a torus touches it all round.
TEST(FieldContact, ABallRestsInATorus) {
  const Primitive torus{.kind = PrimitiveKind::torus, .dimensions_m = {0.03, 0.01}};
  BodyBench bench;
  add_field(bench, {.primitive = &torus}, 0.3);
  bench.add_ball(0.025, 0.05, Vec3(0.001, 0.03, -0.0005), {.friction = 0.3});
  bench.run(3.0);
  const Vec3 center = bench.body(0).motion().center_W;
  EXPECT_NEAR(center.y(), std::sqrt(0.035 * 0.035 - 0.03 * 0.03), 1e-4);
  EXPECT_LT(Vec3(center.x(), 0.0, center.z()).norm(), 1e-4);
}

TEST(FieldContact, ASlabRestsOnATorusAndACapsuleAcrossIt) {
  const Primitive torus{.kind = PrimitiveKind::torus, .dimensions_m = {0.03, 0.01}};
  for (const bool is_slab : {true, false}) {
    BodyBench bench;
    add_field(bench, {.primitive = &torus}, 0.5);
    if (is_slab) {
      bench.add_box(Vec3(0.05, 0.005, 0.06), 0.1, {.translation = {0.003, 0.016, -0.002}}, 0.5);
    } else {
      bench.add({.kind = PrimitiveKind::capsule,
                 .X_WO = {.rotation = body_turned(Vec3::UnitZ(), 0.5 * std::numbers::pi)},
                 .dimensions_m = {0.005, 0.06}},
                mass_of_box(0.1, Vec3(0.06, 0.005, 0.005)), {.translation = {0.0, 0.016, 0.0}},
                {.friction = 0.5});
    }
    bench.run(1.0);
    EXPECT_NEAR(bench.body(0).motion().center_W.y(), 0.015, 1e-4) << is_slab;
    EXPECT_LT(bench.body(0).motion().velocity_W.norm(), 2e-3) << is_slab;
  }
}

}  // namespace
}  // namespace tactus::rendering
