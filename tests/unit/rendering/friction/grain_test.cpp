#include "rendering/friction/grain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/rendering/friction/every_kind.h"

namespace tactus::testing {
namespace {

using rendering::FrictionMemory;
using rendering::Grain;
using rendering::update_friction;

const Grain kGrain{.direction = Vec3{3.0, 4.0, 0.0} / 5.0, .along = 0.25, .across = 1.0};

TEST(Grain, GivesTheCoefficientAlongAndTheOneAcross) {
  for (const NamedFriction& friction : every_kind(1000.0)) {
    rendering::FrictionParameters parameters = friction.parameters;
    parameters.viscous_s_per_m = 0.0;
    parameters.damping_s_per_m = 0.0;
    // Far beyond the Stribeck velocity.
    const Vec3 along = 0.01 * kGrain.direction;
    const Vec3 across = 0.01 * Vec3{-4.0, 3.0, 0.0} / 5.0;
    FrictionMemory<Vec3> memory;
    for (int k = 0; k < 20; ++k) {
      update_friction(parameters, kGrain, memory, along, 2.0, 0.05);
    }
    const auto smooth = update_friction(parameters, kGrain, memory, along, 2.0, 0.05);
    EXPECT_LE((smooth.force_N - 0.25 * along.normalized()).norm(), 1e-9) << friction.name;
    for (int k = 0; k < 20; ++k) {
      update_friction(parameters, kGrain, memory, across, 2.0, 0.05);
    }
    const auto rough = update_friction(parameters, kGrain, memory, across, 2.0, 0.05);
    EXPECT_LE((rough.force_N - across.normalized()).norm(), 1e-9) << friction.name;
  }
}

TEST(Grain, OfEqualCoefficientsIsNone) {
  const Grain none{.direction = kGrain.direction};
  for (const NamedFriction& friction : every_kind(1000.0)) {
    FrictionMemory<Vec3> with;
    FrictionMemory<Vec3> without;
    for (int k = 0; k < 500; ++k) {
      const Vec3 motion{1e-4 * std::sin(0.1 * k), 1e-4 * std::cos(0.13 * k), 0.0};
      const auto a = update_friction(friction.parameters, none, with, motion, 1.0, 1e-3);
      const auto b = update_friction(friction.parameters, without, motion, 1.0, 1e-3);
      ASSERT_LE((a.force_N - b.force_N).norm(), 1e-14);
    }
  }
}

// Slip goes perpendicular to the ellipse of the forces: at 45 degrees to the grain the force turns
// toward the rough direction, by the ratio of the squares.
TEST(Grain, SlipTakesTheMostEnergyThatTheEllipseAllows) {
  rendering::FrictionParameters parameters = every_kind(1000.0)[1].parameters;
  parameters.viscous_s_per_m = 0.0;
  const Vec3 across{-0.8, 0.6, 0.0};
  const Vec3 motion = 0.01 * (kGrain.direction + across);
  FrictionMemory<Vec3> memory;
  for (int k = 0; k < 50; ++k) {
    update_friction(parameters, kGrain, memory, motion, 1.0, 1e-3);
  }
  const Vec3 force = update_friction(parameters, kGrain, memory, motion, 1.0, 1e-3).force_N;
  EXPECT_NEAR(force.dot(kGrain.direction) / force.dot(across), 0.25 * 0.25, 1e-9);
  double most = 0.0;
  for (int degree = 0; degree < 360; ++degree) {
    const double angle = degree * M_PI / 180.0;
    const Vec3 on_ellipse =
        0.5 * (0.25 * std::cos(angle) * kGrain.direction + std::sin(angle) * across);
    most = std::max(most, on_ellipse.dot(motion));
  }
  EXPECT_GE(force.dot(motion), most);
  EXPECT_LE(force.dot(motion), most * 1.001);
}

}  // namespace
}  // namespace tactus::testing
