#include "firmware/safety/passivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

ControllerConfig bare_config(double device_damping, double most_damping) {
  ControllerConfig config;
  config.safety.device_damping_Ns_per_m = device_damping;
  config.safety.passivity_damping_Ns_per_m = most_damping;
  return config;
}

// A mass that swings against a stiff sampled wall which no damping tames: the energy it has when it
// leaves, over what it came with.
double bounce(const ControllerConfig& config) {
  constexpr double kMass = 0.1;
  constexpr double kWallStiffness = 2000.0;
  constexpr double kTick_s = 0.001;
  EnergyAccount account;
  PassivityControl control;
  control.configure(config);
  double x = 0.0005;
  double v = -0.2;
  bool touched = false;
  for (int tick = 0; tick < 1000 && (!touched || x <= 0.0); ++tick) {
    rendering::Touch touch;
    const bool in_contact = x < 0.0;
    touched = touched || in_contact;
    touch.force_W = {in_contact ? -kWallStiffness * x : 0.0, 0.0, 0.0};
    const Vec3 p{x, 0.0, 0.0};
    control.observe(account.settle(p, touch, kTick_s), in_contact);
    const Vec3 force = touch.force_W + control.damp_W({v, 0.0, 0.0}, in_contact);
    account.hold(force);
    v += force.x() / kMass * kTick_s;  // the force is held, the motion exact
    x += (v - 0.5 * force.x() / kMass * kTick_s) * kTick_s;
  }
  return v * v / (0.2 * 0.2);
}

// Energy that shows only in the last step out of the wall is not taken back any more.
TEST(PassivityControl, TakesMostOfASampledWallsSurplusBack) {
  const double surplus = bounce(bare_config(0.0, 0.0)) - 1.0;
  EXPECT_GT(surplus, 0.05);
  EXPECT_LT(bounce(bare_config(0.0, 20.0)) - 1.0, 0.5 * surplus);
}

TEST(PassivityControl, DampingOfTheDevicePaysFirst) {
  PassivityControl control;
  control.configure(bare_config(2.0, 5.0));
  // 1 mm in 1 ms: b way^2 / T = 2 mJ
  control.observe({.given_J = 0.002, .passive_J = 0.002, .way_m2 = 1e-6}, true);
  EXPECT_NEAR(control.credit_J(), 0.0, 1e-15);
  EXPECT_EQ(control.damp_W(Vec3::UnitX(), true), Vec3::Zero());
}

// The same way over a tick and three missed ones is four times as slow, and so is what damping
// takes.
TEST(PassivityControl, DampingOfTheDeviceCountsTheMissedTicks) {
  PassivityControl control;
  control.configure(bare_config(2.0, 5.0));
  control.observe({.way_m2 = 1e-6, .step_s = 0.004}, true);
  EXPECT_NEAR(control.credit_J(), 0.0005, 1e-15);
}

TEST(PassivityControl, ADebtDecaysOverTheMissedTicks) {
  PassivityControl control;
  control.configure(bare_config(0.0, 0.0));
  control.observe({.passive_J = 0.01}, true);
  control.observe({.step_s = 0.1}, true);
  EXPECT_NEAR(control.credit_J(), -0.009, 1e-15);
  control.observe({.step_s = 5.0}, true);
  EXPECT_EQ(control.credit_J(), 0.0) << "a long gap forgets a debt and makes no credit of it";
}

TEST(PassivityControl, ADebtIsPaidByADamperInContactOnly) {
  PassivityControl control;
  control.configure(bare_config(0.0, 5.0));
  control.observe({.given_J = 1e-4, .passive_J = 1e-4, .way_m2 = 0.0}, true);
  EXPECT_EQ(control.damp_W({0.5, 0.0, 0.0}, false), Vec3::Zero());
  // E / (T v^2) = 1e-4 / (1e-3 0.25) = 0.4 N s/m
  EXPECT_TRUE(control.damp_W({0.5, 0.0, 0.0}, true).isApprox(Vec3(-0.2, 0.0, 0.0), 1e-9));
  EXPECT_TRUE(control.damp_W({0.01, 0.0, 0.0}, true).isApprox(Vec3(-0.05, 0.0, 0.0), 1e-9))
      << "no more than the largest damping";
}

TEST(PassivityControl, CreditOfOneTouchDoesNotPayForTheNext) {
  PassivityControl control;
  control.configure(bare_config(0.0, 5.0));
  control.observe({.given_J = -1.0, .passive_J = -1.0, .way_m2 = 0.0}, true);
  EXPECT_EQ(control.credit_J(), 1.0);
  control.observe({}, false);
  EXPECT_EQ(control.credit_J(), 0.0);
}

// 10 N over 3 mm.
TEST(PassivityControl, MoreDebtThanAllowedIsAFault) {
  PassivityControl control;
  control.configure(bare_config(0.0, 0.0));
  EXPECT_EQ(control.observe({.given_J = 0.028, .passive_J = 0.028, .way_m2 = 0.0}, true), kNoFault);
  EXPECT_EQ(control.observe({.given_J = 0.005, .passive_J = 0.005, .way_m2 = 0.0}, true),
            kFaultNotPassive);
}

// The first tick of 1 ms in which a surface's force of 1 N in half sine waves of 20 Hz is a fault,
// while the contact gives `given_J` in each; or -1 within half a second.
int buzz_found_at(double given_J) {
  PassivityControl control;
  control.configure(bare_config(0.0, 0.0));
  for (int tick = 0; tick < 500; ++tick) {
    const double turns = 20.0 * 0.001 * tick;
    const TickEnergy energy{.given_J = given_J,
                            .passive_J = given_J,
                            .way_m2 = 0.0,
                            .contact_N = std::max(0.0, std::sin(2.0 * M_PI * turns)),
                            .step_s = 0.001};
    if (control.observe(energy, true) != kNoFault) {
      return tick;
    }
  }
  return -1;
}

// Far below the energy that is a fault by itself.
TEST(PassivityControl, AContactThatBuzzesIsAFaultWhileItGivesEnergy) {
  EXPECT_GT(buzz_found_at(1e-7), 200);
  EXPECT_LT(buzz_found_at(1e-7), 250);
  EXPECT_EQ(buzz_found_at(-1e-7), -1);
}

}  // namespace
}  // namespace tactus::firmware
