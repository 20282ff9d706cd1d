#include "host_tools/simulation/plant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host_tools/simulation/device_presets.h"

namespace tactus::host {
namespace {

constexpr double kStep_s = 1e-4;
constexpr JointEfforts kNoEffort{};

PlantParameters smooth_plant() {
  PlantParameters parameters;
  parameters.moving_mass_kg = 0.1;
  parameters.viscous_Ns_per_m = 0.5;
  parameters.stop_lower_B = Vec3::Constant(-10.0);
  parameters.stop_upper_B = Vec3::Constant(10.0);
  return parameters;
}

TEST(Plant, FreeMassAcceleratesAndSettlesWithItsViscousTimeConstant) {
  Plant plant(smooth_plant());
  const double tau_s = 0.1 / 0.5;
  for (int k = 1; k <= 10000; ++k) {
    plant.step({2.0, 0.0, 0.0}, Grip{}, kStep_s);
    const double t = k * kStep_s;
    ASSERT_NEAR(plant.v_B().x(), 4.0 * (1.0 - std::exp(-t / tau_s)), 1e-6);
  }
}

TEST(Plant, CoastsByMassTimesVelocityOverViscosity) {
  Plant plant(smooth_plant());
  for (int k = 0; k < 100; ++k) {
    plant.step({1.0, 0.0, 0.0}, Grip{}, kStep_s);
  }
  const double start_m = plant.p_B().x();
  const double speed = plant.v_B().x();
  for (int k = 0; k < 100000; ++k) {
    plant.step(kNoEffort, Grip{}, kStep_s);
  }
  EXPECT_NEAR(plant.p_B().x() - start_m, 0.1 * speed / 0.5, 1e-12);
}

TEST(Plant, SwingsInTheHandsSpringAtTheUndampedFrequency) {
  PlantParameters parameters = smooth_plant();
  parameters.viscous_Ns_per_m = 0.0;
  Plant plant(parameters);
  const Grip grip{.mass_kg = 0.1, .stiffness_N_per_m = 300.0, .wish_p_B = {0.01, 0.0, 0.0}};
  int crossings = 0;
  double last_crossing_s = 0.0;
  double before = -0.01;
  for (int k = 1; k <= 200000; ++k) {
    plant.step(kNoEffort, grip, kStep_s);
    const double now = plant.p_B().x() - 0.01;
    if (before < 0.0 && now >= 0.0) {
      ++crossings;
      last_crossing_s = kStep_s * (k - now / (now - before));
    }
    before = now;
  }
  const double omega = std::sqrt(300.0 / 0.2);
  const double expected_s =
      (0.5 * std::numbers::pi + 2.0 * std::numbers::pi * (crossings - 1)) / omega;
  EXPECT_NEAR(last_crossing_s, expected_s, 1e-5 * expected_s);
  // The midpoint rule keeps the amplitude: spring and kinetic energy add up to what the stretch
  // held.
  const double energy_J = 0.5 * 0.2 * plant.v_B().squaredNorm() +
                          0.5 * 300.0 * (grip.wish_p_B - plant.p_B()).squaredNorm();
  EXPECT_NEAR(energy_J, 0.5 * 300.0 * 1e-4, 1e-12);
}

TEST(Plant, RestsWhereTheHandsSpringBalancesTheMotor) {
  Plant plant(smooth_plant());
  const Grip grip{.mass_kg = 0.1, .stiffness_N_per_m = 300.0, .damping_Ns_per_m = 5.0};
  for (int k = 0; k < 50000; ++k) {
    plant.step({0.6, -0.3, 0.0}, grip, kStep_s);
  }
  EXPECT_LT((plant.p_B() - Vec3(0.002, -0.001, 0.0)).norm(), 1e-9);
}

TEST(Plant, FrictionHoldsBelowBreakAwayAndYieldsAbove) {
  PlantParameters parameters = cartesian_preset().device.plant;
  const double break_away = parameters.joint_friction.static_level;
  const double give_m = break_away / parameters.joint_friction.stiffness_N_per_m;
  Plant held(parameters);
  Plant moved(parameters);
  for (int k = 0; k < 20000; ++k) {
    const double ramp = std::min(1.0, k / 10000.0);
    held.step({0.7 * break_away * ramp, 0.0, 0.0}, Grip{}, kStep_s);
    moved.step({1.3 * break_away * ramp, 0.0, 0.0}, Grip{}, kStep_s);
  }
  EXPECT_LT(std::abs(held.p_B().x()), 10.0 * give_m);
  EXPECT_LT(std::abs(held.v_B().x()), 1e-3);
  EXPECT_GT(moved.p_B().x(), 1e-3);
}

TEST(Plant, KineticEnergyIsTheSumOfTheLedger) {
  for (const DevicePreset& preset : {cartesian_preset(), falcon_preset()}) {
    Plant plant(preset.device.plant);
    plant.place(preset.centre_B);
    const bool falcon = preset.device.plant.mechanism == MechanismKind::falcon_delta;
    const double effort = falcon ? 0.05 : 1.0;
    Grip grip{.mass_kg = 0.1, .stiffness_N_per_m = 300.0, .damping_Ns_per_m = 5.0};
    for (int k = 0; k < 20000; ++k) {
      const double t = k * kStep_s;
      grip.wish_p_B =
          preset.centre_B + Vec3(0.03 * std::sin(9.0 * t), 0.02 * std::sin(7.0 * t), 0.0);
      plant.step({effort * std::sin(20.0 * t), -effort * std::cos(31.0 * t), 0.0}, grip, kStep_s);
    }
    const double mass = preset.device.plant.moving_mass_kg + 0.1;
    const EnergyLedger& ledger = plant.ledger();
    EXPECT_NEAR(0.5 * mass * plant.v_B().squaredNorm(),
                ledger.motors_J + ledger.hand_J + ledger.viscous_J + ledger.friction_and_stops_J,
                1e-12);
    EXPECT_LT(ledger.viscous_J, 0.0);
    EXPECT_LT(ledger.friction_and_stops_J, 0.0);
  }
}

// Nobody drives: motors off, the hand's wish at rest. The energy stored in motion, hand, bristles
// and stops may only fall.
TEST(Plant, LeftAloneItNeverGainsEnergy) {
  for (const DevicePreset& preset : {cartesian_preset(), falcon_preset()}) {
    Plant plant(preset.device.plant);
    const Vec3 start_B = preset.centre_B + Vec3(0.03, -0.02, 0.025);
    plant.place(start_B);
    const Grip grip{.mass_kg = 0.1, .stiffness_N_per_m = 300.0, .wish_p_B = preset.centre_B};
    const double mass = preset.device.plant.moving_mass_kg + grip.mass_kg;
    const auto energy_J = [&] {
      return 0.5 * mass * plant.v_B().squaredNorm() + plant.stored_energy_J() +
             0.5 * grip.stiffness_N_per_m * (grip.wish_p_B - plant.p_B()).squaredNorm();
    };
    const double first_J = energy_J();
    double lowest_J = first_J;
    double worst_gain_J = 0.0;
    for (int k = 0; k < 50000; ++k) {
      plant.step(kNoEffort, grip, kStep_s);
      worst_gain_J = std::max(worst_gain_J, energy_J() - lowest_J);
      lowest_J = std::min(lowest_J, energy_J());
    }
    EXPECT_LT(worst_gain_J, 1e-6 * first_J);
    EXPECT_LT(energy_J(), 1e-2 * first_J);
  }
}

TEST(Plant, StopsHoldTheHandleNearTheBox) {
  PlantParameters parameters = cartesian_preset().device.plant;
  Plant plant(parameters);
  for (int k = 0; k < 20000; ++k) {
    plant.step({10.0, 0.0, 0.0}, Grip{}, kStep_s);
  }
  EXPECT_NEAR(plant.p_B().x(), 0.12 + 10.0 / 20e3, 1e-5);
}

}  // namespace
}  // namespace tactus::host
