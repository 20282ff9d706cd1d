#include "host_tools/emulators/emulated_machine.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr hal::TimeNs kMillisecond = 1'000'000;

// A machine whose three motors do what the test says.
struct Bench {
  explicit Bench(const EmulatedMachineConfig& config,
                 const std::array<drivers::Transmission, 3>& transmissions = {})
      : machine(config, 0) {
    for (std::size_t i = 0; i < machine.joints(); ++i) {
      machine.connect({.shaft = &shafts[i],
                       .transmission = transmissions[i],
                       .set_fault = [this, i](EmulatorFault fault) { faults[i] = fault; }});
    }
  }
  std::array<EmulatedShaft, 3> shafts{};
  std::array<EmulatorFault, 3> faults{};
  EmulatedMachine machine;
};

// A cartesian device's joints are the handle's coordinates, so that everything is known.
TEST(EmulatedMachine, ShaftsTurnWithTheirJointsThroughTheirTransmissions) {
  EmulatedMachineConfig config;
  config.hand = kFirmHand;
  config.hand.tremor_m = 0.0;
  config.path = WishPath({{0.0, {0.0, 0.0, 0.0}}, {0.1, {0.02, -0.01, 0.03}}});
  Bench bench(config, {{{.encoder_ratio = 100.0, .encoder_direction = -1.0, .offset = 0.01},
                        {.encoder_ratio = 50.0},
                        {.encoder_ratio = 10.0, .offset = -0.5}}});
  for (int tick = 0; tick < 200; ++tick) {
    bench.machine.run(tick * kMillisecond);
    const MachineTruth& truth = bench.machine.truth();
    EXPECT_EQ(truth.time_ns, tick * kMillisecond);
    EXPECT_NEAR(bench.shafts[0].position_rad, -100.0 * (truth.handle_p_B.x() - 0.01), 1e-9);
    EXPECT_NEAR(bench.shafts[1].position_rad, 50.0 * truth.handle_p_B.y(), 1e-9);
    EXPECT_NEAR(bench.shafts[2].position_rad, 10.0 * (truth.handle_p_B.z() + 0.5), 1e-9);
    EXPECT_NEAR(bench.shafts[0].velocity_rad_per_s, -100.0 * truth.handle_v_B.x(), 1e-9);
    EXPECT_NEAR(bench.shafts[1].velocity_rad_per_s, 50.0 * truth.handle_v_B.y(), 1e-9);
  }
  EXPECT_NEAR(bench.machine.truth().handle_p_B.z(), 0.03, 0.003);  // the hand led it there
}

TEST(EmulatedMachine, TorqueReachesTheHandleByVirtualWork) {
  EmulatedMachineConfig config;
  config.device = woodenhaptics_preset();
  config.hand = kPenHand;
  config.origin_B = config.device.centre_B;
  Bench bench(config, {{{.motor_ratio = 16.0, .encoder_ratio = 16.0},
                        {.motor_ratio = 12.0, .motor_direction = -1.0},
                        {.motor_ratio = 12.0}}});
  for (int tick = 0; tick < 300; ++tick) {
    for (std::size_t i = 0; i < 3; ++i) {
      bench.shafts[i].torque_Nm = 0.02 * std::sin(0.05 * tick + 2.0 * static_cast<double>(i));
    }
    bench.machine.run(tick * kMillisecond);
    const MachineTruth& truth = bench.machine.truth();
    const double at_joints_W = 16.0 * bench.shafts[0].torque_Nm * truth.joint_velocity[0] -
                               12.0 * bench.shafts[1].torque_Nm * truth.joint_velocity[1] +
                               12.0 * bench.shafts[2].torque_Nm * truth.joint_velocity[2];
    EXPECT_NEAR(truth.motor_force_B.dot(truth.handle_v_B), at_joints_W, 1e-12);
    EXPECT_EQ(truth.shaft_torque_Nm[1], bench.shafts[1].torque_Nm);
  }
}

// At rest the hand carries what the links weigh, but for the joints' friction.
TEST(EmulatedMachine, HandForceIsWhatHoldsTheHandle) {
  EmulatedMachineConfig config;
  config.device = cartesian_preset();
  config.hand = kPenHand;
  config.hand.tremor_m = 0.0;
  Bench bench(config);
  bench.shafts[1].torque_Nm = -1.5;
  bench.machine.run(2000 * kMillisecond);
  const MachineTruth& truth = bench.machine.truth();
  EXPECT_NEAR(truth.hand_force_B.y(), 1.5, 0.06);
  EXPECT_NEAR(truth.hand_force_B.x(), 0.0, 0.06);
  EXPECT_NEAR(truth.handle_p_B.y(), -1.5 / kPenHand.stiffness_N_per_m, 0.06 / 300.0);
}

TEST(EmulatedMachine, WithoutAHandItStartsInTheMiddleOfItsWorkspaceAndFalls) {
  EmulatedMachineConfig config;
  config.device = woodenhaptics_preset();
  Bench bench(config);
  bench.machine.run(0);
  EXPECT_EQ(bench.machine.truth().handle_p_B, config.device.centre_B);
  bench.machine.run(1000 * kMillisecond);
  EXPECT_LT(bench.machine.truth().handle_p_B.y(), config.device.centre_B.y() - 0.05);
  EXPECT_EQ(bench.machine.truth().hand_force_B, Vec3::Zero());
}

TEST(EmulatedMachine, DevicesRunAtEachStepWithItsTime) {
  EmulatedMachine machine({.step_ns = 50'000}, 1000);
  std::vector<hal::TimeNs> times;
  machine.add_device([&](hal::TimeNs now_ns) { times.push_back(now_ns); });
  machine.run(101'000);
  EXPECT_EQ(times, (std::vector<hal::TimeNs>{1000, 51'000, 101'000}));
  machine.skip_to(260'000);
  EXPECT_EQ(machine.next_step_ns(), 301'000);
}

TEST(EmulatedMachine, FaultsGoToTheirAxisAndIntoTheTruth) {
  Bench bench({});
  bench.machine.set_fault(1, EmulatorFault::delayed);
  EXPECT_EQ(bench.faults[0], EmulatorFault::none);
  EXPECT_EQ(bench.faults[1], EmulatorFault::delayed);
  EXPECT_EQ(bench.machine.truth().fault[1], EmulatorFault::delayed);
}

TEST(EmulatedMachine, RefusesMoreAxesThanJointsAndWhatIsNoTransmission) {
  EmulatedShaft shaft;
  EmulatedMachineConfig config;
  config.device = hapkit_preset();
  EmulatedMachine machine(config, 0);
  EXPECT_THROW(machine.connect({.shaft = &shaft, .transmission = {.motor_ratio = 0.0}}),
               InputError);
  machine.connect({.shaft = &shaft});
  EXPECT_THROW(machine.connect({.shaft = &shaft}), InputError);
  EXPECT_THROW(EmulatedMachine({.step_ns = 0}, 0), InputError);
  EXPECT_THROW(EmulatedMachine({.step_ns = 200'000}, 0), InputError);
}

}  // namespace
}  // namespace tactus::host
