#include "rendering/contact/potential_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "tests/support/connected_solid.h"
#include "tests/support/csv.h"

namespace tactus::rendering {
namespace {

constexpr double kStiffness = 500.0;

Primitive plate(double thickness_m) {
  return {.kind = PrimitiveKind::box, .dimensions_m = {0.1, 0.5 * thickness_m, 0.1}};
}

Vec3 force(const FieldPush& push, double stiffness) {
  return stiffness * push.depth_m * push.normal_W;
}

// The hardest push upward on a tool that moves down through the object.
template <class Object>
double greatest_resistance(const Object& object, double stiffness, double half_path_m,
                           double radius_m) {
  constexpr int kSteps = 20'000;
  double greatest = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const Vec3 tool(0.001, half_path_m * (1.0 - 2.0 * i / kSteps), 0.002);
    greatest = std::max(greatest, force(potential_field(object, tool, radius_m), stiffness).y());
  }
  return greatest;
}

TEST(PotentialField, PushesAPointAndASphereOutByTheShortestWay) {
  const Primitive ball{.kind = PrimitiveKind::sphere, .dimensions_m = {0.05}};
  const FieldPush point = potential_field(ball, {0.03, 0.0, 0.0}, 0.0);
  EXPECT_NEAR(point.depth_m, 0.02, 1e-15);
  EXPECT_LT((force(point, kStiffness) - Vec3(10.0, 0.0, 0.0)).norm(), 1e-12);
  const FieldPush sphere = potential_field(ball, {0.0, 0.051, 0.0}, 0.002);
  EXPECT_LT((force(sphere, kStiffness) - Vec3(0.0, 0.5, 0.0)).norm(), 1e-12);
  const FieldPush outside = potential_field(ball, {0.0, 0.053, 0.0}, 0.002);
  EXPECT_EQ(outside.depth_m, 0.0);
  EXPECT_EQ(outside.normal_W, Vec3::Zero());
}

TEST(PotentialField, ABoxOfTrianglesPushesLikeABoxOfPlanes) {
  constexpr std::uint64_t kSeed = 61;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> place(-0.05, 0.05);
  const testing::ConnectedSolid mesh(testing::box({0.0625, 0.03125, 0.046875}));
  const Primitive box{.kind = PrimitiveKind::box, .dimensions_m = {0.03125, 0.015625, 0.0234375}};
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 tool(place(random), place(random), place(random));
    const double radius = i % 2 == 0 ? 0.0 : 0.004;
    const FieldPush of_mesh = potential_field(mesh.mesh(), tool, radius);
    const FieldPush of_box = potential_field(box, tool, radius);
    ASSERT_NEAR(of_mesh.depth_m, of_box.depth_m, 1e-12) << "seed 61, case " << i;
    ASSERT_LT(
        kStiffness * (of_mesh.depth_m * of_mesh.normal_W - of_box.depth_m * of_box.normal_W).norm(),
        1e-9)
        << "seed 61, case " << i;
  }
}

// thin_object_penetration.csv: a hand that presses with F sinks in by F / K, and only a plate of
// twice that thickness can hold it.
TEST(PotentialField, APlateHoldsAHandOnlyIfItIsTwiceAsThickAsTheHandSinksIn) {
  const testing::Csv table("thin_object_penetration.csv");
  ASSERT_GT(table.rows(), 0U);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double stiffness = table.number(row, "k_N_m");
    const double held = table.number(row, "F_N");
    const double sink_m =
        1e-3 *
        table.number(row,
                     "penetration_mm(=min slab thickness for penalty methods x2 for value-based "
                     "nearest side)");
    EXPECT_NEAR(
        stiffness * potential_field({.kind = PrimitiveKind::plane}, {0, -sink_m, 0}, 0.0).depth_m,
        held, 1e-9);
    EXPECT_GE(greatest_resistance(plate(2.02 * sink_m), stiffness, 0.05, 0.0), held);
    EXPECT_LT(greatest_resistance(plate(1.98 * sink_m), stiffness, 0.05, 0.0), held);
  }
}

TEST(PotentialField, PopsThroughAThinPlateAndIsThenPushedOutOfTheFarSide) {
  const testing::ConnectedSolid mesh(testing::box({0.125, 0.00390625, 0.125}));
  const double half = 0.5 * 0.00390625;
  const auto push = [&](double y) {
    return force(potential_field(mesh.mesh(), {0.001, y, 0.002}, 0.0), kStiffness);
  };
  EXPECT_NEAR(push(1e-6).y(), kStiffness * (half - 1e-6), 1e-9);
  EXPECT_NEAR(push(-1e-6).y(), -kStiffness * (half - 1e-6), 1e-9);
  EXPECT_NEAR(greatest_resistance(mesh.mesh(), kStiffness, 0.01, 0.0), kStiffness * half, 1e-3);
}

// At 2 m/s and 1 kHz a tick is 2 mm: a plate of 1.9 mm lies between two ticks.
TEST(PotentialField, NeverNoticesAPlateThatIsThinnerThanOneTicksTravel) {
  EXPECT_EQ(potential_field(plate(0.0019), {0, 0.001, 0}, 0.0).depth_m, 0.0);
  EXPECT_EQ(potential_field(plate(0.0019), {0, -0.001, 0}, 0.0).depth_m, 0.0);
}

}  // namespace
}  // namespace tactus::rendering
