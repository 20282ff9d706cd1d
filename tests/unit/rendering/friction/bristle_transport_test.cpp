// The bristle round a corner and onto another surface.
#include "rendering/friction/bristle_transport.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "tests/unit/rendering/friction/every_kind.h"

namespace tactus::testing {
namespace {

using rendering::change_stiffness;
using rendering::FrictionMemory;
using rendering::turned;
using rendering::update_friction;

Vec3 random_unit(std::mt19937_64& random) {
  std::normal_distribution<double> any;
  return Vec3{any(random), any(random), any(random)}.normalized();
}

Vec3 random_tangent(std::mt19937_64& random, const Vec3& normal) {
  const Vec3 v = random_unit(random);
  return v - normal.dot(v) * normal;
}

TEST(Carry, IsTheLeastRotationFromOneNormalToTheOther) {
  constexpr std::uint64_t kSeed = 3;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 from = random_unit(random);
    const Vec3 to = random_unit(random);
    const Vec3 tangent = random_tangent(random, from);
    const Vec3 axis = from.cross(to);
    const double angle_rad = std::atan2(axis.norm(), from.dot(to));
    const Vec3 expected = Eigen::AngleAxisd(angle_rad, axis.normalized()) * tangent;
    // The oracle itself loses digits as the normals come to point apart.
    ASSERT_LE((turned(tangent, from, to) - expected).norm(), 1e-14 / (1.0 + from.dot(to)) + 1e-14);
  }
}

TEST(Carry, KeepsTheLengthAndThePlaneHoweverFarTheNormalTurns) {
  constexpr std::uint64_t kSeed = 5;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 from = random_unit(random);
    const double off = std::pow(10.0, -(i % 18));
    const Vec3 to = (off * random_unit(random) - from).normalized();
    const Vec3 tangent = random_tangent(random, from);
    const Vec3 there = turned(tangent, from, to);
    ASSERT_NEAR(there.norm(), tangent.norm(), 1e-14);
    ASSERT_NEAR(there.dot(to), 0.0, 1e-15);
  }
}

TEST(Carry, LeavesABristleBetweenOppositeNormalsAsItIs) {
  const Vec3 tangent{0.3, 0.4, 0.0};
  EXPECT_EQ(turned(tangent, Vec3::UnitZ(), -Vec3::UnitZ()), tangent);
  EXPECT_EQ(turned(tangent, Vec3::UnitZ(), Vec3::UnitZ()), tangent);
}

// Round a square bar and back to where it began, again and again.
TEST(Carry, SlidingRoundCornersNeitherJumpsNorGivesOutEnergy) {
  for (const NamedFriction& friction : every_kind(1000.0)) {
    FrictionMemory<Vec3> memory;
    double work_J = 0.0;
    double last_N = 0.0;
    for (int corner = 0; corner < 40; ++corner) {
      const double angle = 0.5 * M_PI * corner;
      const Vec3 normal{std::cos(angle), std::sin(angle), 0.0};
      const Vec3 along{-std::sin(angle), std::cos(angle), 0.0};
      for (int k = 0; k < 100; ++k) {
        const Vec3 motion = 1e-4 * along + 3e-5 * std::sin(0.1 * k) * Vec3::UnitZ();
        const auto result = update_friction(friction.parameters, memory, motion, 1.0, 1e-3);
        work_J += result.mean_force_N.dot(motion);
        ASSERT_GE(work_J, stored_J(friction.parameters, memory) - 1e-12) << friction.name;
        ASSERT_NEAR(result.force_N.dot(normal), 0.0, 1e-14);
        last_N = result.force_N.norm();
      }
      const Vec3 next{std::cos(angle + 0.5 * M_PI), std::sin(angle + 0.5 * M_PI), 0.0};
      memory.elastic_force_N = turned(memory.elastic_force_N, normal, next);
      const Vec3 motion = 1e-4 * normal * -1.0;
      const auto after = update_friction(friction.parameters, memory, motion, 1.0, 1e-3);
      work_J += after.mean_force_N.dot(motion);
      EXPECT_NEAR(after.force_N.norm(), last_N, 0.05) << friction.name;
    }
  }
}

TEST(Carry, AnotherStiffnessAddsNeitherForceNorEnergy) {
  rendering::FrictionParameters before = every_kind(1000.0).front().parameters;
  rendering::FrictionParameters after = before;
  for (const double old_stiffness : {0.0, 10.0, 1000.0}) {
    for (const double new_stiffness : {0.0, 10.0, 1000.0, 1e5}) {
      before.stiffness_N_per_m = old_stiffness;
      after.stiffness_N_per_m = new_stiffness;
      FrictionMemory<Vec3> memory{.elastic_force_N = {0.0, 3.0, 4.0}};
      const double energy_J = stored_J(before, memory);
      change_stiffness(memory, old_stiffness, new_stiffness);
      EXPECT_LE(stored_J(after, memory), energy_J * (1.0 + 1e-15));
      EXPECT_LE(memory.elastic_force_N.norm(), 5.0);
      if (new_stiffness == 0.0 || (old_stiffness > 0.0 && new_stiffness >= old_stiffness)) {
        EXPECT_EQ(memory.elastic_force_N, Vec3(0.0, 3.0, 4.0));
      }
    }
  }
}

}  // namespace
}  // namespace tactus::testing
