// Melder and Harwin's cone against the reference runs on a plane (tests/reference/README.md).
#include "rendering/friction/cone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "rendering/world/world.h"
#include "tests/support/csv.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Csv;

struct Run {
  std::string file;
  double static_coefficient;
  double dynamic_coefficient;
};

// Prints the name of a run in messages of GoogleTest.
void PrintTo(const Run& run, std::ostream* out) {
  *out << run.file;
}

class ConeRuns : public ::testing::TestWithParam<Run> {};

Vec3 vector_at(const Csv& csv, std::size_t row, const std::string& prefix) {
  return {csv.number(row, prefix + "x_m"), csv.number(row, prefix + "y_m"),
          csv.number(row, prefix + "z_m")};
}

// Rows at which the state of the reference changes: exact ties, decided by rounding.
bool near_transition(const Csv& csv, std::size_t row) {
  const auto state = [&](std::size_t k) { return csv.number(k, "state(0free,1stick,2slip)"); };
  return (row > 0 && state(row) != state(row - 1)) ||
         (row + 1 < csv.rows() && state(row) != state(row + 1));
}

TEST_P(ConeRuns, TheStateMachineFollowsTheReferenceOnAPlane) {
  const Csv csv(GetParam().file);
  Vec3 proxy = Vec3::Zero();
  FrictionState state = FrictionState::free;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const Vec3 tool = vector_at(csv, row, "h");
    const Vec3 frictionless{tool.x(), tool.y(), 0.0};
    const double depth = -tool.z();
    const FrictionStep step = apply_cone(
        proxy, frictionless,
        {GetParam().static_coefficient * depth, GetParam().dynamic_coefficient * depth}, state);
    proxy = step.goal;
    state = step.state;
    if (near_transition(csv, row)) {
      // Go on from the reference, so that one tie is one row's difference.
      proxy = vector_at(csv, row, "g");
      state = static_cast<FrictionState>(csv.number(row, "state(0free,1stick,2slip)"));
      continue;
    }
    ASSERT_LE((proxy - vector_at(csv, row, "g")).norm(), 1e-12) << "row " << row;
    ASSERT_EQ(static_cast<int>(state), csv.number(row, "state(0free,1stick,2slip)"))
        << "row " << row;
  }
}

// The same runs through the whole renderer: a god-object point on a flat mesh. It rests half a
// micrometre above the plane, so positions agree to a micrometre and transitions to one sample.
TEST_P(ConeRuns, TheWorldFollowsTheReferenceOnAFlatMesh) {
  const Csv csv(GetParam().file);
  testing::Shape plate{.name = "plate", .closed = false};
  plate.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  plate.triangles = {{0, 1, 2}, {0, 2, 3}};
  const testing::Solid solid(
      plate, Sides::one,
      {.stiffness_N_per_m = 1.0,
       .friction = cone_friction(GetParam().static_coefficient, GetParam().dynamic_coefficient)});
  World world;
  ASSERT_TRUE(world.set_scene({&solid.object(), 1}, {}));
  world.touch({.p_W = {0.0, 0.0, 0.001}});
  constexpr double kFree = 0.0;
  const bool has_friction = GetParam().static_coefficient > 0.0;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const Touch touch = world.touch({.p_W = vector_at(csv, row, "h")});
    const Vec3 force{csv.number(row, "fx_over_k_m"), csv.number(row, "fy_over_k_m"),
                     csv.number(row, "fz_over_k_m")};
    // At a tie one sample of 50 um of motion may pass before the transition.
    const double tolerance = near_transition(csv, row) ? 2e-3 : 1.5e-6;
    ASSERT_LE((touch.proxy_W - vector_at(csv, row, "g")).norm(), tolerance) << "row " << row;
    ASSERT_LE((touch.force_W - force).norm(), tolerance) << "row " << row;
    // The reference calls a contact without friction a slip; a touch reports neither stick nor
    // slip.
    const double state = has_friction ? csv.number(row, "state(0free,1stick,2slip)") : kFree;
    if (!near_transition(csv, row)) {
      ASSERT_EQ(static_cast<int>(touch.friction), state) << "row " << row;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Reference, ConeRuns,
                         ::testing::Values(Run{"frictioncone_A_straight_mus0.8_mud0.5.csv", 0.8,
                                               0.5},
                                           Run{"frictioncone_B_straight_mus_mud_0.5.csv", 0.5, 0.5},
                                           Run{"frictioncone_C_reversal.csv", 0.8, 0.5},
                                           Run{"frictioncone_D_depth_ramp.csv", 0.8, 0.5},
                                           Run{"frictioncone_H_frictionless.csv", 0.0, 0.0}));

TEST(FrictionCone, TheSlippingProxyLagsByTheTabulatedAngle) {
  const Csv csv("frictioncone_table.csv");
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double mu = csv.number(row, "mu");
    const double depth = csv.number(row, "depth_m");
    const FrictionStep step =
        apply_cone({1.0, 0.0, 0.0}, Vec3::Zero(), {mu * depth, mu * depth}, FrictionState::slip);
    const Vec3 tool{0.0, 0.0, -depth};
    EXPECT_NEAR(step.goal.norm(), csv.number(row, "circle_radius_m"), 1e-15);
    EXPECT_NEAR(std::atan2(step.goal.norm(), depth) * 180.0 / M_PI,
                csv.number(row, "lag_angle_deg"), 1e-9);
    EXPECT_NEAR((step.goal - tool).norm(), csv.number(row, "god_object_HIP_distance_m"), 1e-13);
  }
}

TEST(FrictionCone, ADynamicCoefficientAboveTheStaticOneNeverPushesTheProxyAway) {
  const FrictionStep step =
      apply_cone({0.003, 0.0, 0.0}, Vec3::Zero(), {0.001, 0.005}, FrictionState::stick);
  EXPECT_EQ(step.goal, Vec3(0.003, 0.0, 0.0));
}

}  // namespace
}  // namespace tactus::rendering
