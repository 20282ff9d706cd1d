#include "host_tools/simulation/simulated_device.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host_tools/input_error.h"
#include "host_tools/simulation/device_presets.h"

namespace tactus::host {
namespace {

constexpr double kTick_s = 1e-3;
constexpr HandParameters kNoHand{};

// Returns a device that has only mass, and is homed at once.
DeviceParameters bare_device() {
  DeviceParameters parameters;
  parameters.plant.viscous_Ns_per_m = 0.0;
  parameters.motor_time_constant_s = 0.0;
  parameters.power_up_s = 0.0;
  parameters.homing_s = 0.0;
  return parameters;
}

void advance_alone(SimulatedDevice& device, int ticks = 1) {
  for (int i = 0; i < ticks; ++i) {
    device.advance(kNoHand, Vec3::Zero(), Vec3::Zero());
  }
}

drivers::JointSample read(const SimulatedDevice& device) {
  drivers::JointSample sample;
  device.read(sample);
  return sample;
}

drivers::JointCommand pull(double force_N) {
  drivers::JointCommand command;
  command.effort[0] = force_N;
  command.enable = true;
  return command;
}

TEST(SimulatedDevice, ACommandActsExactlyOneTickLater) {
  SimulatedDevice device(bare_device(), kTick_s, Vec3::Zero());
  device.write(pull(1.0));
  advance_alone(device);
  EXPECT_EQ(device.plant().v_B().x(), 0.0);
  device.write(pull(0.0));
  advance_alone(device);
  EXPECT_NEAR(device.plant().v_B().x(), 1.0 * kTick_s / 0.1, 1e-15);
  advance_alone(device);
  EXPECT_NEAR(device.plant().v_B().x(), 1.0 * kTick_s / 0.1, 1e-15);
}

TEST(SimulatedDevice, ACommandWithoutEnableDrivesNothing) {
  SimulatedDevice device(bare_device(), kTick_s, Vec3::Zero());
  drivers::JointCommand command = pull(5.0);
  command.enable = false;
  device.write(command);
  advance_alone(device, 3);
  EXPECT_EQ(device.plant().v_B().x(), 0.0);
}

TEST(SimulatedDevice, PowersUpThenHomesAndCountsFromTheTrueOriginAfterwards) {
  DeviceParameters parameters = bare_device();
  parameters.power_up_s = 0.005;
  parameters.homing_s = 0.01;
  SimulatedDevice device(parameters, kTick_s, {0.03, 0.0, 0.0});
  for (int tick = 0; tick < 20; ++tick) {
    const drivers::JointSample sample = read(device);
    const std::uint32_t expected = tick < 5    ? drivers::kDeviceNotReady
                                   : tick < 15 ? drivers::kDeviceHoming
                                               : drivers::kDeviceOk;
    EXPECT_EQ(sample.status, expected) << "tick " << tick;
    EXPECT_NEAR(sample.position[0], tick < 15 ? 0.0 : 0.03, 2.5e-6) << "tick " << tick;
    EXPECT_EQ(sample.velocity[0], 0.0) << "tick " << tick;
    advance_alone(device);
  }
}

TEST(SimulatedDevice, FalconReadsItsShoulderAngles) {
  DeviceParameters parameters = falcon_preset().device;
  parameters.power_up_s = 0.0;
  parameters.homing_s = 0.0;
  SimulatedDevice device(parameters, kTick_s, {0.01, -0.015, 0.12});
  const drivers::JointSample sample = read(device);
  const double degree = std::acos(-1.0) / 180.0;
  const double half_count = 0.5 * 0.0364347 * degree;
  EXPECT_NEAR(sample.position[0], 35.773455 * degree, half_count * 1.001);
  EXPECT_NEAR(sample.position[1], 16.687995 * degree, half_count * 1.001);
  EXPECT_NEAR(sample.position[2], 22.885544 * degree, half_count * 1.001);
}

TEST(SimulatedDevice, AStaleSampleRepeatsGrowsOldAndRecovers) {
  SimulatedDevice device(bare_device(), kTick_s, Vec3::Zero());
  device.write(pull(1.0));
  advance_alone(device, 50);
  const drivers::JointSample last = read(device);
  device.inject(DeviceFault::stale_sample, 3);
  for (std::uint32_t i = 1; i <= 3; ++i) {
    advance_alone(device);
    const drivers::JointSample sample = read(device);
    EXPECT_EQ(sample.position[0], last.position[0]);
    EXPECT_EQ(sample.age_us, 1000 * i);
    EXPECT_EQ(sample.status, drivers::kDeviceStale);
  }
  advance_alone(device);
  EXPECT_EQ(read(device).status, drivers::kDeviceOk);
  EXPECT_EQ(read(device).age_us, 0U);
  EXPECT_NE(read(device).position[0], last.position[0]);
}

TEST(SimulatedDevice, AnEncoderFaultReadsNotANumberOnce) {
  SimulatedDevice device(bare_device(), kTick_s, Vec3::Zero());
  device.inject(DeviceFault::encoder_nan, 1);
  advance_alone(device);
  EXPECT_TRUE(std::isnan(read(device).position[0]));
  advance_alone(device);
  EXPECT_EQ(read(device).position[0], 0.0);
}

TEST(SimulatedDevice, EmergencyStopCutsTheMotorsAndLatchesUntilCleared) {
  SimulatedDevice device(bare_device(), kTick_s, Vec3::Zero());
  device.write(pull(1.0));
  advance_alone(device, 5);
  EXPECT_EQ(device.motor_effort()[0], 1.0);
  device.inject(DeviceFault::emergency_stop, 2);
  advance_alone(device, 2);
  EXPECT_EQ(device.motor_effort()[0], 0.0);
  advance_alone(device, 5);
  EXPECT_EQ(read(device).status, drivers::kDeviceEmergencyStop);
  EXPECT_EQ(device.motor_effort()[0], 0.0);
  device.clear_faults();
  advance_alone(device);
  EXPECT_EQ(read(device).status, drivers::kDeviceOk);
  EXPECT_EQ(device.motor_effort()[0], 1.0);
}

TEST(SimulatedDevice, ALostDeviceSaysSoInReadAndWriteAndLetsGo) {
  SimulatedDevice device(bare_device(), kTick_s, Vec3::Zero());
  device.write(pull(1.0));
  advance_alone(device, 5);
  device.inject(DeviceFault::lost, 10);
  advance_alone(device, 2);
  EXPECT_EQ(read(device).status, drivers::kDeviceLost);
  EXPECT_EQ(device.write(pull(1.0)), drivers::kDeviceLost);
  EXPECT_EQ(device.motor_effort()[0], 0.0);
}

TEST(SimulatedDevice, RefusesFewerThanTenSubstepsAndSlowRates) {
  DeviceParameters parameters = bare_device();
  EXPECT_THROW(SimulatedDevice(parameters, 1.0, Vec3::Zero()), InputError);
  parameters.substeps = 9;
  EXPECT_THROW(SimulatedDevice(parameters, kTick_s, Vec3::Zero()), InputError);
}

}  // namespace
}  // namespace tactus::host
