// Three emulated ODrive axes, from springs that hold the arm to every fault of the port.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "drivers/odrive_can/odrive_can.h"
#include "host_tools/emulators/odrive_emulator.h"
#include "tests/unit/host_tools/emulators/emulated_arm.h"

namespace tactus::host {
namespace {

struct ODriveArm : EmulatedArm<drivers::ODriveCan> {
  explicit ODriveArm(const std::vector<PlannedFault>& faults = {}, const HandParameters& hand = {})
      : EmulatedArm({.driver =
                         [](std::uint8_t i) {
                           return drivers::ODriveCan({.node_id = i, .max_torque_Nm = kArmLimit_Nm});
                         },
                     .emulator =
                         [](hal::CanBus& bus, std::uint8_t i) {
                           return std::make_unique<ODriveEmulator>(
                               bus, i + 1U,
                               ODriveEmulatorConfig{.node_id = i,
                                                    .encoder = EmulatedEncoder::multi_turn,
                                                    .heartbeat_ms = 10});
                         }},
                    faults, hand) {}
};

TEST(EmulatedODrives, VirtualSpringsHoldTheArmAgainstItsWeight) {
  ODriveArm device;
  device.ticks(600, [&](int) { device.hold(); });
  ASSERT_TRUE(device.are_well()) << device.board.trouble(0).what;
  device.ticks(3000, [&](int) { device.hold(); });
  ASSERT_TRUE(device.are_well());
  const MachineTruth& truth = device.machine->truth();
  EXPECT_LT(truth.handle_v_B.norm(), 1e-3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(truth.joint_position[i], device.middle[i], 0.02) << i;  // 0.4 N m on 20 N m/rad
  }
}

TEST(EmulatedODrives, DriverKnowsWhereTheJointsTrulyAreToTheAgeOfItsSamples) {
  ODriveArm device({}, kPenHand);
  device.ticks(600, [&](int) { device.hold(); });
  double fastest_rad_per_s = 0.0;
  device.ticks(2000, [&](int tick) {
    ASSERT_TRUE(device.are_well());
    const double swing = 0.15 * std::sin(0.006 * tick);
    device.hold({swing, -swing, swing});
    for (std::size_t i = 0; i < 3; ++i) {
      const hal::TimeNs age_ns = device.clock.now_ns() - device.samples[i].time_ns;
      EXPECT_LT(age_ns, 1'100'000);
      // A frame waits for five others at most (estimates, heartbeats), 0.14 ms each.
      const MachineTruth& truth = device.truth_at(device.samples[i].time_ns);
      const double speed = std::abs(truth.joint_velocity[i]);
      fastest_rad_per_s = std::max(fastest_rad_per_s, speed);
      EXPECT_NEAR(device.joint(i), truth.joint_position[i], 1e-6 + 0.9e-3 * (speed + 0.05))
          << "joint " << i << " at tick " << tick;
    }
  });
  EXPECT_GT(fastest_rad_per_s, 0.3);
  const auto still = [&](int) { device.hold(); };
  device.ticks(3000, still);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(device.joint(i), device.machine->truth().joint_position[i], 2e-5);
  }
}

TEST(EmulatedODrives, PlantFeelsTheTorqueThatWasCommanded) {
  ODriveArm device({}, kPenHand);
  device.ticks(600);
  std::array<double, 3> commanded_Nm{};
  device.ticks(1000, [&](int tick) {
    const MachineTruth& truth = device.machine->truth();
    for (std::size_t i = 0; i < 3; ++i) {
      if (tick > 0) {
        EXPECT_NEAR(truth.shaft_torque_Nm[i], commanded_Nm[i], 1e-7) << "tick " << tick;
      }
      commanded_Nm[i] = 0.05 * std::sin(0.02 * tick + static_cast<double>(i));
      device.commands[i] = {.torque_Nm = commanded_Nm[i], .enable = true};
    }
  });
  EXPECT_TRUE(device.are_well());
}

struct FaultCase {
  const char* kind;
  std::uint32_t status;  // one of these bits is to come
  double within_s;
};

class EmulatedODriveFault : public ::testing::TestWithParam<FaultCase> {};

// After the fault the driver notices in time, the other axes stay well, and the motor's torque
// ends. After healing and a reset the axis works again.
TEST_P(EmulatedODriveFault, IsNoticedAfterItsTimeAndHeals) {
  const FaultCase& fault = GetParam();
  constexpr double kAt_s = 0.7;
  ODriveArm device({parse_planned_fault(std::string("1:") + fault.kind + "@0.7"),
                    parse_planned_fault("1:none@1.5")},
                   kPenHand);
  double noticed_s = 0.0;
  double zero_s = 0.0;
  device.ticks(1400, [&](int) {
    device.hold();
    if (noticed_s == 0.0 && device.seconds() > 0.6 && device.samples[1].status != 0) {
      noticed_s = device.seconds();
      EXPECT_NE(device.samples[1].status & fault.status, 0U) << device.samples[1].status;
    }
    const bool has_torque = device.machine->truth().shaft_torque_Nm[1] != 0.0;
    zero_s = has_torque ? 0.0 : zero_s == 0.0 ? device.seconds() : zero_s;
  });
  EXPECT_GE(noticed_s, kAt_s);
  EXPECT_LE(noticed_s, kAt_s + fault.within_s);
  EXPECT_GE(zero_s, kAt_s);
  EXPECT_LE(zero_s, noticed_s + 0.005);
  EXPECT_TRUE(device.board.trouble(1)) << "latched";
  EXPECT_EQ(device.samples[0].status, drivers::kDeviceOk);
  EXPECT_EQ(device.samples[2].status, drivers::kDeviceOk);

  device.ticks(200);
  device.board.clear_faults();
  device.ticks(700, [&](int) { device.hold(); });
  EXPECT_TRUE(device.are_well()) << device.board.trouble(1).what;
  EXPECT_NE(device.machine->truth().shaft_torque_Nm[1], 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    EveryFault, EmulatedODriveFault,
    ::testing::Values(FaultCase{"silent", drivers::kDeviceStale | drivers::kDeviceLost, 0.006},
                      FaultCase{"delayed", drivers::kDeviceStale | drivers::kDeviceLost, 0.006},
                      FaultCase{"corrupted", ~0U, 0.1},
                      FaultCase{"erroring", drivers::kDeviceDriveFault, 0.02},
                      FaultCase{"unplugged", drivers::kDeviceStale | drivers::kDeviceLost, 0.006},
                      FaultCase{"power_cycled", drivers::kDeviceStale | drivers::kDeviceLost,
                                0.006}),
    [](const auto& one) { return std::string(one.param.kind); });

TEST(EmulatedODrives, SameSeedsGiveTheSameRunToTheBit) {
  std::array<MachineTruth, 2> ends;
  for (MachineTruth& end : ends) {
    ODriveArm device({parse_planned_fault("0:corrupted@0.5")}, kFingerHand);
    device.ticks(1000, [&](int) { device.hold(); });
    end = device.machine->truth();
  }
  EXPECT_EQ(ends[0].joint_position, ends[1].joint_position);
  EXPECT_EQ(ends[0].handle_v_B, ends[1].handle_v_B);
  EXPECT_EQ(ends[0].shaft_torque_Nm, ends[1].shaft_torque_Nm);
}

}  // namespace
}  // namespace tactus::host
