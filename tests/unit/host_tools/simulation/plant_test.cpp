#include "host_tools/simulation/plant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host_tools/simulation/device_presets.h"

namespace tactus::host {
namespace {

constexpr double kPlantStep_s = 1e-4;
constexpr JointEfforts kNoEffort{};

PlantParameters smooth_plant() {
  PlantParameters parameters;
  parameters.moving_mass_kg = 0.1;
  parameters.viscous_Ns_per_m = 0.5;
  parameters.stop_lower_B = Vec3::Constant(-10.0);
  parameters.stop_upper_B = Vec3::Constant(10.0);
  return parameters;
}

std::vector<DevicePreset> all_presets() {
  return {cartesian_preset(),        falcon_preset(),          hapkit_preset(),
          haply_pantograph_preset(), phantom_premium_preset(), woodenhaptics_preset()};
}

TEST(Plant, FreeMassAcceleratesAndSettlesWithItsViscousTimeConstant) {
  Plant plant(smooth_plant());
  const double tau_s = 0.1 / 0.5;
  for (int k = 1; k <= 10000; ++k) {
    plant.step({2.0, 0.0, 0.0}, Grip{}, kPlantStep_s);
    const double t = k * kPlantStep_s;
    ASSERT_NEAR(plant.v_B().x(), 4.0 * (1.0 - std::exp(-t / tau_s)), 1e-6);
  }
}

TEST(Plant, CoastsByMassTimesVelocityOverViscosity) {
  Plant plant(smooth_plant());
  for (int k = 0; k < 100; ++k) {
    plant.step({1.0, 0.0, 0.0}, Grip{}, kPlantStep_s);
  }
  const double start_m = plant.p_B().x();
  const double speed = plant.v_B().x();
  for (int k = 0; k < 100000; ++k) {
    plant.step(kNoEffort, Grip{}, kPlantStep_s);
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
    plant.step(kNoEffort, grip, kPlantStep_s);
    const double now = plant.p_B().x() - 0.01;
    if (before < 0.0 && now >= 0.0) {
      ++crossings;
      last_crossing_s = kPlantStep_s * (k - now / (now - before));
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
    plant.step({0.6, -0.3, 0.0}, grip, kPlantStep_s);
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
    held.step({0.7 * break_away * ramp, 0.0, 0.0}, Grip{}, kPlantStep_s);
    moved.step({1.3 * break_away * ramp, 0.0, 0.0}, Grip{}, kPlantStep_s);
  }
  EXPECT_LT(std::abs(held.p_B().x()), 10.0 * give_m);
  EXPECT_LT(std::abs(held.v_B().x()), 1e-3);
  EXPECT_GT(moved.p_B().x(), 1e-3);
}

TEST(Plant, KineticEnergyIsTheSumOfTheLedger) {
  for (const DevicePreset& preset : all_presets()) {
    Plant plant(preset.device.plant);
    plant.place(preset.centre_B);
    const double effort = 0.1 * preset.device.effort_limit;
    Grip grip{.mass_kg = 0.1, .stiffness_N_per_m = 300.0, .damping_Ns_per_m = 5.0};
    for (int k = 0; k < 20000; ++k) {
      const double t = k * kPlantStep_s;
      grip.wish_p_B =
          preset.centre_B + Vec3(0.03 * std::sin(9.0 * t), 0.02 * std::sin(7.0 * t), 0.0);
      plant.step({effort * std::sin(20.0 * t), -effort * std::cos(31.0 * t), 0.0}, grip,
                 kPlantStep_s);
    }
    const double mass = preset.device.plant.moving_mass_kg + 0.1;
    const EnergyLedger& ledger = plant.ledger();
    EXPECT_NEAR(0.5 * mass * plant.v_B().squaredNorm(),
                ledger.motors_J + ledger.hand_J + ledger.viscous_J + ledger.friction_and_stops_J +
                    ledger.weight_J,
                1e-12);
    EXPECT_LT(ledger.viscous_J, 0.0);
    EXPECT_LT(ledger.friction_and_stops_J, 0.0);
  }
}

// Nobody drives: motors off, the hand's wish at rest. The energy stored in motion, hand, bristles
// and stops may only fall.
TEST(Plant, LeftAloneItNeverGainsEnergy) {
  for (const DevicePreset& preset : all_presets()) {
    Plant plant(preset.device.plant);
    const Vec3 start_B = preset.centre_B + Vec3(0.03, -0.02, 0.025);
    plant.place(start_B);
    const Grip grip{.mass_kg = 0.1, .stiffness_N_per_m = 300.0, .wish_p_B = preset.centre_B};
    const double mass = preset.device.plant.moving_mass_kg + grip.mass_kg;
    const auto energy_J = [&] {
      return 0.5 * mass * plant.v_B().squaredNorm() + plant.stored_energy_J() +
             plant.potential_J() +
             0.5 * grip.stiffness_N_per_m * (grip.wish_p_B - plant.p_B()).squaredNorm();
    };
    const double first_J = energy_J();
    double lowest_J = first_J;
    double worst_gain_J = 0.0;
    for (int k = 0; k < 50000; ++k) {
      plant.step(kNoEffort, grip, kPlantStep_s);
      worst_gain_J = std::max(worst_gain_J, energy_J() - lowest_J);
      lowest_J = std::min(lowest_J, energy_J());
    }
    EXPECT_LT(worst_gain_J, 1e-6 * first_J);
    if (plant.potential_J() == 0.0) {  // weights come to rest where the hand carries them
      EXPECT_LT(energy_J(), 1e-2 * first_J);
    }
  }
}

// A paddle that stands on its head: heavy side up in a gravity that pulls up.
TEST(Plant, APaddleSwingsAsAPendulum) {
  PlantParameters parameters = smooth_plant();
  parameters.mechanism = PaddleLengths{};
  parameters.viscous_Ns_per_m = 0.0;
  parameters.handle_kg = 0.05;
  parameters.gravity_B = {0.0, 10.0, 0.0};
  Plant plant(parameters);
  const double radius_m = plant.p_B().y();
  plant.place({0.001, radius_m, 0.0});
  const double start_J = plant.potential_J();
  int crossings = 0;
  double last_crossing_s = 0.0;
  double before_m = plant.p_B().x();
  for (int k = 1; k <= 30000; ++k) {
    plant.step(kNoEffort, Grip{}, kPlantStep_s);
    ASSERT_NEAR(plant.p_B().norm(), radius_m, 1e-15);
    ASSERT_NEAR(plant.v_B().dot(plant.p_B()), 0.0, 1e-15);
    const double now_m = plant.p_B().x();
    if (before_m > 0.0 && now_m <= 0.0) {
      ++crossings;
      last_crossing_s = kPlantStep_s * (k - now_m / (now_m - before_m));
    }
    before_m = now_m;
  }
  const double omega = std::sqrt(0.05 * 10.0 / (0.1 * radius_m));
  EXPECT_NEAR(omega * last_crossing_s, 2.0 * std::numbers::pi * (crossings - 0.75), 0.01);
  const double energy_J = 0.5 * 0.1 * plant.v_B().squaredNorm() + plant.potential_J();
  EXPECT_NEAR(energy_J, start_J, 1e-7);
}

TEST(Plant, AForceAcrossItsPlaneDoesNotMoveAPantograph) {
  Plant plant(haply_pantograph_preset().device.plant);
  plant.place({0.01, 0.0, 0.075});
  const Grip grip{.stiffness_N_per_m = 300.0, .wish_p_B = {0.01, 0.05, 0.075}};
  for (int k = 0; k < 1000; ++k) {
    plant.step(kNoEffort, grip, kPlantStep_s);
  }
  EXPECT_EQ(plant.p_B(), Vec3(0.01, 0.0, 0.075));
}

// The moments are computed by hand: 0.17 kg at 51 mm of the upper arm, and 0.11 kg at 91 mm of a
// forearm on its end.
TEST(Plant, AWeightedArmFallsWithItsOwnMoments) {
  PlantParameters parameters = woodenhaptics_preset().device.plant;
  parameters.joint_friction = {};
  parameters.stop_lower_B = Vec3::Constant(-1.0);
  parameters.stop_upper_B = Vec3::Constant(1.0);
  Plant plant(parameters);
  const double reach_m = 0.205 + 0.245 * std::sin(std::numbers::pi / 4.0);
  plant.place({0.0, 0.08 - 0.245 * std::cos(std::numbers::pi / 4.0), reach_m});  // upper arm level
  constexpr double kG = 9.80665;
  const JointEfforts holding = {0.0, kG * (0.17 * 0.051 + 0.11 * 0.205),
                                kG * 0.11 * 0.091 * std::sin(std::numbers::pi / 4.0)};
  plant.step(holding, Grip{}, kPlantStep_s);
  EXPECT_LT(plant.v_B().norm(), 1e-12);
  plant.step(kNoEffort, Grip{}, kPlantStep_s);
  EXPECT_LT(plant.v_B().y(), -1e-4);
}

TEST(Plant, StopsHoldTheHandleNearTheBox) {
  PlantParameters parameters = cartesian_preset().device.plant;
  Plant plant(parameters);
  for (int k = 0; k < 20000; ++k) {
    plant.step({10.0, 0.0, 0.0}, Grip{}, kPlantStep_s);
  }
  EXPECT_NEAR(plant.p_B().x(), 0.12 + 10.0 / 20e3, 1e-5);
}

}  // namespace
}  // namespace tactus::host
