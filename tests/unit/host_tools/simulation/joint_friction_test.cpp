#include "host_tools/simulation/joint_friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using rendering::FrictionParameters;

// Table I of Canudas de Wit et al. 1995.
FrictionParameters table_one() {
  return {.kind = FrictionKind::lugre,
          .coulomb = 1.0,
          .static_level = 1.5,
          .viscous_s_per_m = 0.4,
          .stribeck_velocity_m_per_s = 0.001,
          .stiffness_N_per_m = 1e5,
          .damping_s_per_m = std::sqrt(1e5)};
}

double bend_m(const JointFriction& joint, double stiffness_N_per_m) {
  return std::sqrt(2.0 * joint.stored_energy_J() / stiffness_N_per_m);
}

TEST(JointFriction, ReachesTheSteadyStribeckCurve) {
  for (const double velocity : {0.0001, 0.001, 0.002986321, 0.01, 0.1, -0.003}) {
    JointFriction joint(table_one());
    double force = 0.0;
    for (int i = 0; i < 500000; ++i) {
      force = joint.advance(velocity, 1e-5);
    }
    const double ratio = velocity / 0.001;
    const double expected =
        std::copysign(1.0 + 0.5 * std::exp(-ratio * ratio), velocity) + 0.4 * velocity;
    EXPECT_NEAR(force, expected, 1e-9) << "at " << velocity << " m/s";
  }
}

// The reference's exact update for x = 0.1/(2 pi) ... sampled at 1 kHz: first rows of the published
// recurrence.
TEST(JointFriction, RepeatsTheReferenceRecurrence) {
  JointFriction joint(table_one());
  const double x1 = 3.14158231816e-07;
  const double x2 = 1.25662052484e-06;
  EXPECT_NEAR(joint.advance(x1 / 1e-3, 1e-3), 0.129483565676, 1e-11);
  EXPECT_NEAR(bend_m(joint, 1e5), 3.107863361e-07, 1e-16);
  EXPECT_NEAR(joint.advance((x2 - x1) / 1e-3, 1e-3), 0.399068066012, 1e-11);
}

TEST(JointFriction, BendNeverExceedsTheBreakAwayBend) {
  JointFriction joint(table_one());
  for (int i = 0; i < 100000; ++i) {
    const double t = 1e-4 * i;
    joint.advance(5.0 * std::sin(3.0 * t) * std::cos(41.0 * t), 1e-4);
    ASSERT_LE(bend_m(joint, 1e5), 15e-6 * (1.0 + 1e-12));
  }
}

// Without Stribeck's dip LuGre is Dahl's model, whose steady loop of amplitude A encloses 4 Fc (A -
// Fc/s0 tanh(s0 A/Fc)).
TEST(JointFriction, HysteresisLoopDissipatesDahlsClosedForm) {
  JointFriction joint({.kind = FrictionKind::lugre,
                       .coulomb = 1.0,
                       .static_level = 1.0,
                       .stribeck_velocity_m_per_s = 1.0,
                       .stiffness_N_per_m = 1e5});
  const double amplitude = 20e-6;
  const int steps = 200000;
  double area_J = 0.0;
  double force_before = 0.0;
  for (int cycle = 0; cycle < 3; ++cycle) {
    area_J = 0.0;
    for (int i = 0; i < steps; ++i) {
      const auto position = [&](int k) {
        return amplitude * std::sin(2.0 * std::numbers::pi * k / steps);
      };
      const double moved = position(i + 1) - position(i);
      const double force = joint.advance(moved / 1e-5, 1e-5);
      area_J += 0.5 * (force_before + force) * moved;
      force_before = force;
    }
  }
  EXPECT_NEAR(area_J, 4.143890e-5, 1e-9);
}

// A mass pulled by a spring whose far end creeps at 0.1 m/s: the paper's Fig. 6, period from the
// reference solution.
TEST(JointFriction, StickSlipHasTheReferencePeriod) {
  JointFriction joint(table_one());
  const double h = 2.5e-4;
  double x = 0.0;
  double v = 0.0;
  double first_slip_s = 0.0;
  double last_slip_s = 0.0;
  int slips = 0;
  bool slipping = false;
  for (int k = 0; k < 4 * 30000; ++k) {
    const double t = k * h;
    v += h * (2.0 * (0.1 * t - x) - joint.advance(v, h));
    x += h * v;
    if (!slipping && v > 0.01) {
      ++slips;
      (slips == 1 ? first_slip_s : last_slip_s) = t;
    }
    slipping = v > (slipping ? 0.001 : 0.01);
  }
  ASSERT_GE(slips, 3);
  EXPECT_NEAR(first_slip_s, 7.4580, 0.01);
  EXPECT_NEAR((last_slip_s - first_slip_s) / (slips - 1), 6.3627, 0.01);
}

TEST(JointFriction, WithoutCoulombFrictionOnlyViscousIsLeft) {
  JointFriction joint(
      {.kind = FrictionKind::lugre, .viscous_s_per_m = 3.0, .stiffness_N_per_m = 1.0});
  EXPECT_EQ(joint.advance(-2.0, 1e-3), -6.0);
}

}  // namespace
}  // namespace tactus::host
