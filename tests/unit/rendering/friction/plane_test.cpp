// Two tangential dimensions: paths with closed forms, and that no direction is better than another.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <random>

#include "tests/unit/rendering/friction/every_kind.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::testing {
namespace {

using rendering::FrictionForce;
using rendering::FrictionKind;
using rendering::FrictionMemory;
using rendering::FrictionParameters;
using rendering::update_friction;

Vec3 circle(double phase) {
  return {0.02 * std::cos(phase), 0.02 * std::sin(phase), 0.0};
}

Vec3 figure_eight(double phase) {
  return {0.02 * std::sin(phase), 0.01 * std::sin(2.0 * phase), 0.0};
}

// A tractrix that begins one unit away from the x axis, along which its end is drawn.
Vec3 tractrix(double phase) {
  const double s = 2.0 * (phase - std::sin(phase));
  return {0.01 * (s - std::tanh(s)), 0.01 / std::cosh(s), 0.0};
}

using Path = Vec3 (*)(double);
constexpr std::array<Path, 3> kPaths{circle, figure_eight, tractrix};

class EveryKindInThePlane : public ::testing::TestWithParam<NamedFriction> {};

TEST_P(EveryKindInThePlane, RotatesWithItsMotion) {
  constexpr std::uint64_t kSeed = 11;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const Path path : kPaths) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond{any(random), any(random), any(random), any(random)}.normalized();
    const Mat3 rotation = turn.toRotationMatrix();
    FrictionMemory<Vec3> here;
    FrictionMemory<Vec3> there;
    for (int k = 0; k < 2000; ++k) {
      const Vec3 motion = path(0.01 * (k + 1)) - path(0.01 * k);
      const double normal = 1.0 + 0.5 * std::sin(0.07 * k);
      const auto a = update_friction(GetParam().parameters, here, motion, normal, kTick_s);
      const auto b =
          update_friction(GetParam().parameters, there, Vec3{rotation * motion}, normal, kTick_s);
      ASSERT_LE((rotation * a.force_N - b.force_N).norm(), 1e-12) << k;
      ASSERT_LE((rotation * a.mean_force_N - b.mean_force_N).norm(), 1e-12) << k;
      ASSERT_EQ(a.slipping, b.slipping) << k;
    }
  }
}

TEST_P(EveryKindInThePlane, IsTheJointsFrictionOnAStraightLine) {
  const Vec3 line = Vec3{1.0, -2.0, 0.5}.normalized();
  FrictionMemory<Vec3> plane;
  FrictionMemory<double> joint;
  for (int k = 0; k < 3000; ++k) {
    const double motion = 2e-4 * std::sin(0.0001 * k * k) * std::sin(0.01 * k);
    const auto a = update_friction(GetParam().parameters, plane, Vec3{motion * line}, 2.0, kTick_s);
    const auto b = update_friction(GetParam().parameters, joint, motion, 2.0, kTick_s);
    ASSERT_LE((a.force_N - b.force_N * line).norm(), 1e-12) << k;
    ASSERT_NEAR(a.mean_force_N.dot(line), b.mean_force_N, 1e-12) << k;
  }
}

TEST_P(EveryKindInThePlane, NeverExceedsItsLevelAndNeverLeavesThePlane) {
  const FrictionParameters& p = GetParam().parameters;
  for (const Path path : kPaths) {
    FrictionMemory<Vec3> memory;
    for (int k = 0; k < 5000; ++k) {
      const Vec3 motion = path(0.007 * (k + 1)) - path(0.007 * k);
      const double normal = 0.5 + 0.5 * std::sin(0.03 * k);
      const auto result = update_friction(p, memory, motion, normal, kTick_s);
      ASSERT_LE(memory.elastic_force_N.norm(), p.static_level * normal * (1.0 + 1e-9));
      ASSERT_EQ(result.force_N.z(), 0.0);
    }
  }
}

// A closed path, gone round until the force repeats: what went in is heat.
TEST_P(EveryKindInThePlane, LosesEnergyOnEveryRoundAndRepeatsItself) {
  for (const Path path : {circle, figure_eight}) {
    FrictionMemory<Vec3> memory;
    constexpr int kTicks = 1000;
    double work_J = 0.0;
    Vec3 last = Vec3::Zero();
    for (int round = 0; round < 4; ++round) {
      work_J = 0.0;
      last = memory.elastic_force_N;
      for (int k = 0; k < kTicks; ++k) {
        const double turn = 2.0 * M_PI / kTicks;
        const Vec3 motion = path((k + 1) * turn) - path(k * turn);
        work_J += update_friction(GetParam().parameters, memory, motion, 1.0, kTick_s)
                      .mean_force_N.dot(motion);
      }
    }
    EXPECT_LE((memory.elastic_force_N - last).norm(), 1e-9);
    EXPECT_GT(work_J, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKindInThePlane, ::testing::ValuesIn(every_kind(1000.0)),
                         [](const auto& kind) { return kind.param.name; });

// On a circle of radius r at a steady pace dz/ds = u - z / l, l = Fc / sigma0, has the solution
// that turns along: in complex numbers z = l u / (1 + i l / r). So the bristle is shorter than l
// and lags behind the tangent by atan(l / r).
TEST(BristleInThePlane, LagsBehindTheTangentOfACircleByTheClosedForm) {
  FrictionParameters parameters = published(FrictionKind::dahl);
  parameters.stiffness_N_per_m = 1000.0;
  constexpr int kTicks = 100'000;
  constexpr double kRadius_m = 2e-3;
  FrictionMemory<Vec3> memory;
  Vec3 place{kRadius_m, 0.0, 0.0};
  for (int k = 1; k <= 4 * kTicks; ++k) {
    const std::complex<double> turn = std::polar(kRadius_m, 2.0 * M_PI * k / kTicks);
    const Vec3 next{turn.real(), turn.imag(), 0.0};
    update_friction(parameters, memory, Vec3{next - place}, 1.0, kTick_s);
    place = next;
  }
  const double length_m = parameters.coulomb / parameters.stiffness_N_per_m;
  const std::complex<double> tangent{0.0, 1.0};
  const std::complex<double> bristle =
      length_m * tangent / std::complex<double>{1.0, length_m / kRadius_m};
  EXPECT_NEAR(memory.elastic_force_N.x(), 1000.0 * bristle.real(), 1e-4);
  EXPECT_NEAR(memory.elastic_force_N.y(), 1000.0 * bristle.imag(), 1e-4);
}

}  // namespace
}  // namespace tactus::testing
