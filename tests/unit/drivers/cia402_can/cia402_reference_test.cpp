// Every way in which the zero of a CiA 402 drive may move unseen, and those in which it stays.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "drivers/cia402_can/cia402_can.h"
#include "drivers/cia402_can/error_codes.h"
#include "host_tools/emulators/cia402_emulator.h"
#include "tests/unit/drivers/can_rig.h"
#include "tests/unit/drivers/one_joint.h"

namespace tactus::drivers {
namespace {

using Cia402Joint = OneJoint<Cia402Can, host::Cia402Emulator>;
using ReferenceRig = CanRig<Cia402Can, host::Cia402Emulator>;
using host::EmulatedEncoder;

std::unique_ptr<Cia402Joint> cia402_joint(EmulatedEncoder encoder = EmulatedEncoder::incremental) {
  return std::make_unique<Cia402Joint>(Cia402Config{.max_torque_Nm = 0.5},
                                       host::Cia402EmulatorConfig{.encoder = encoder});
}

class Cia402Reference : public ::testing::TestWithParam<EmulatedEncoder> {};

INSTANTIATE_TEST_SUITE_P(Encoder, Cia402Reference,
                         ::testing::Values(EmulatedEncoder::incremental,
                                           EmulatedEncoder::absolute));

TEST_P(Cia402Reference, IsGoneAfterEveryKindOfLossUntilTheJointIsHomed) {
  for (const Loss<Cia402Joint>& loss : common_losses<Cia402Joint>()) {
    SCOPED_TRACE(loss.name);
    const auto joint = cia402_joint(GetParam());
    bring_up_and_home(*joint);
    loss.happen(*joint);
    expect_only_homing_brings_it_back(*joint, loss.name);
  }
}

// Without the bit the joint would be wrong by what the encoder forgot: that is why it is latched.
TEST_P(Cia402Reference, DriveCountsFromItsEncodersStartAfterALossOfPower) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  ReferenceRig rig({}, std::vector<Cia402Config>{{.max_torque_Nm = 0.5}},
                   std::vector<host::Cia402EmulatorConfig>{{.encoder = GetParam()}});
  rig.emulator(0).shaft().position_rad = 2.25 * kTurn_rad;
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  const double known_rad = GetParam() == EmulatedEncoder::incremental ? 0.0 : 0.25 * kTurn_rad;
  EXPECT_NEAR(rig.sample(0).position_rad, known_rad, 1e-9);
  rig.emulator(0).set_fault(host::EmulatorFault::power_cycled);
  rig.run(100 * kMs);
  rig.emulator(0).shaft().position_rad = -0.5 * kTurn_rad;
  rig.run(500 * kMs);
  EXPECT_NE(rig.sample(0).status & kDeviceReferenceLost, 0U);
  rig.board().stop();
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  const double then_rad = GetParam() == EmulatedEncoder::incremental ? 0.0 : 0.5 * kTurn_rad;
  EXPECT_NEAR(rig.sample(0).position_rad, then_rad, 1e-9);
}

TEST(Cia402References, StaysThroughAFaultThatLeavesThePositionAlone) {
  const auto joint = cia402_joint();
  bring_up_and_home(*joint);
  joint->emulator().set_fault(host::EmulatorFault::erroring);
  joint->ticks(200);
  EXPECT_NE(joint->sample().status & kDeviceDriveFault, 0U);
  joint->move(0.2);
  joint->emulator().set_fault(host::EmulatorFault::none);
  joint->reset();
  EXPECT_EQ(joint->sample().status, kDeviceOk) << joint->device().trouble().trouble.what;
  EXPECT_NEAR(joint->sample().position[0], 0.5, 0.02);
}

// The electronics live on, whether the drive leaves 'operation enabled' or only says that the
// voltage is gone.
TEST(Cia402References, StaysWhenTheMotorsSupplyAloneGoes) {
  for (const bool stays_enabled : {false, true}) {
    Cia402Joint joint(Cia402Config{.max_torque_Nm = 0.5},
                      host::Cia402EmulatorConfig{.stays_enabled_unsupplied = stays_enabled});
    bring_up_and_home(joint);
    joint.command() = {.enable = true};
    joint.ticks(50);
    ASSERT_EQ(joint.sample().status, kDeviceOk);
    joint.emulator().set_motor_power(false);
    joint.ticks(3);
    EXPECT_NE(joint.sample().status & kDeviceDriveFault, 0U) << stays_enabled;
    EXPECT_EQ(joint.sample().status & kDeviceReferenceLost, 0U) << stays_enabled;
    joint.command() = {};
    joint.move(0.2);
    joint.emulator().set_motor_power(true);
    joint.reset();
    EXPECT_EQ(joint.sample().status, kDeviceOk) << joint.device().trouble().trouble.what;
    EXPECT_NEAR(joint.sample().position[0], 0.5, 0.02);
  }
}

// The frames of a drive that starts anew, so soon that nothing is missing: 'not ready to switch
// on', and pre-operational without an error.
TEST(Cia402References, FramesOfAStartLoseTheReferenceWithoutABootUpMessage) {
  for (const char* frame : {"181#0000000000000000", "701#7F"}) {
    ReferenceRig rig({}, std::vector<Cia402Config>{{.max_torque_Nm = 0.5}},
                     std::vector<host::Cia402EmulatorConfig>{{}});
    rig.start();
    ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
    hal::SimulatedCanBus restarted(rig.network());
    ASSERT_TRUE(restarted.send(frame_of(frame)));
    rig.run(2 * kMs);
    EXPECT_NE(rig.sample(0).status & kDeviceReferenceLost, 0U) << frame;
  }
}

// A drive that leaves operational because the host overslept has told so before.
TEST(Cia402References, StaysWhenAHostThatOversleptIsFoundOut) {
  ReferenceRig rig({}, std::vector<Cia402Config>{{.max_torque_Nm = 0.5}},
                   std::vector<host::Cia402EmulatorConfig>{{}});
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.idle(30 * kMs);
  rig.run(50 * kMs);
  EXPECT_NE(rig.sample(0).status & kDeviceDriveFault, 0U);
  EXPECT_EQ(rig.sample(0).status & kDeviceReferenceLost, 0U);
  EXPECT_EQ(rig.board().trouble(0).code, 0x8130U);
}

// The expectations follow the classes of CiA 301 and the codes of CiA 402 (IEC 61800-7-201).
TEST(Cia402References, CodesOfSuppliesEncodersAndRestartsMoveTheZero) {
  for (const std::uint16_t code :
       std::to_array<std::uint16_t>({0x3110, 0x3120, 0x3210, 0x3220, 0x3221, 0x5100, 0x5112, 0x5113,
                                     0x6010, 0x7300, 0x7305, 0x7320})) {
    EXPECT_TRUE(cia402::may_move_zero(code)) << std::hex << code;
  }
  for (const std::uint16_t code :
       std::to_array<std::uint16_t>({0x0000, 0x1000, 0x2310, 0x4310, 0x5000, 0x5200, 0x6000, 0x6100,
                                     0x7100, 0x8130, 0xFF01})) {
    EXPECT_FALSE(cia402::may_move_zero(code)) << std::hex << code;
  }
}

}  // namespace
}  // namespace tactus::drivers
