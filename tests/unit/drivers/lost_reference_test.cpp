// Every way in which the zero of an ODrive's or a VESC's position may move unseen, through a
// ComposedDevice: the joint must not be referenced afterwards until it is homed again.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "drivers/can_board.h"
#include "drivers/composed_device.h"
#include "drivers/odrive_can/odrive_can.h"
#include "drivers/vesc_can/vesc_can.h"
#include "hal/simulated/can_bus.h"
#include "hal/simulated/can_network.h"
#include "hal/simulated/clock.h"
#include "host_tools/emulators/odrive_emulator.h"
#include "host_tools/emulators/vesc_emulator.h"

namespace tactus::drivers {
namespace {

using host::EmulatorFault;

constexpr hal::TimeNs kTick_ns = 1'000'000;
constexpr double kRatio = 10.0;

// One joint in a known pose at 0, on one drive.
template <class Driver, class Emulator>
class OneJoint final : private hal::SimulatedEventSource {
 public:
  template <class DriverConfig, class EmulatorConfig>
  OneJoint(const DriverConfig& driver, const EmulatorConfig& drive) : emulator_(node_, 1, drive) {
    EXPECT_TRUE(board_.add(Driver(driver)));
    EXPECT_TRUE(device_.add_board(BoardRef(board_)));
    EXPECT_TRUE(device_.add_joint({.name = "paddle",
                                   .transmission = {.motor_ratio = kRatio, .encoder_ratio = kRatio},
                                   .reference = {.kind = ReferenceKind::known_pose},
                                   .max_torque_Nm = 1.0}));
    next_ns_ = clock_.now_ns();
    clock_.attach(*this);
    device_.start();
  }
  OneJoint(const OneJoint&) = delete;
  OneJoint& operator=(const OneJoint&) = delete;
  ~OneJoint() { clock_.detach(*this); }

  void ticks(int count) {
    for (int i = 0; i < count; ++i) {
      device_.read(sample_);
      (void)device_.write(command_);
      clock_.advance_by(kTick_ns);
    }
  }
  // The hand turns the joint, within the shaft's speed.
  void move(double joint_rad) {
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      emulator_.shaft().position_rad += kRatio * joint_rad / kSteps;
      ticks(1);
    }
  }
  // As an operator does it: reset, wait until the drive is up, home.
  void reset() {
    device_.clear_faults();
    ticks(2500);
  }
  void home() {
    command_ = {.home = true};
    ticks(510);  // it must stand still for half a second
    command_ = {};
    ticks(5);
  }
  // The joint is far from its pose and says so rightly, or does not claim to be referenced.
  void expect_lost() const {
    EXPECT_NE(sample_.status & (kDeviceNotReady | kDeviceReferenceLost), 0U) << sample_.status;
    EXPECT_EQ(device_.lost_reference().joint, "paddle");
    EXPECT_FALSE(device_.lost_reference().trouble.what.empty());
  }

  Emulator& emulator() { return emulator_; }
  hal::SimulatedCanBus& host() { return host_; }
  hal::SimulatedCanNetwork& network() { return network_; }
  ComposedDevice& device() { return device_; }
  [[nodiscard]] const JointSample& sample() const { return sample_; }
  JointCommand& command() { return command_; }

 private:
  hal::TimeNs next_event_ns() const override { return next_ns_; }
  void run_event() override {
    emulator_.run(next_ns_);
    next_ns_ += 50'000;
  }

  hal::SimulatedClock clock_;
  hal::SimulatedCanNetwork network_{clock_, {.bit_rate = 1'000'000}};
  hal::SimulatedCanBus host_{network_};
  hal::SimulatedCanBus node_{network_};
  CanBoard<Driver> board_{host_, clock_};
  Emulator emulator_;
  ComposedDevice device_{clock_, 300'000};
  JointSample sample_;
  JointCommand command_;
  hal::TimeNs next_ns_ = 0;
};

using ODriveJoint = OneJoint<ODriveCan, host::ODriveEmulator>;
using VescJoint = OneJoint<VescCan, host::VescEmulator>;

std::unique_ptr<ODriveJoint> odrive_joint(host::ODriveFirmware firmware) {
  return std::make_unique<ODriveJoint>(
      ODriveConfig{.torque_constant_Nm_per_A = 0.055, .heartbeat_lost_s = 0.035},
      host::ODriveEmulatorConfig{.firmware = firmware, .heartbeat_ms = 10});
}

std::unique_ptr<VescJoint> vesc_joint() {
  return std::make_unique<VescJoint>(VescConfig{.torque_constant_Nm_per_A = 0.03,
                                                .max_torque_Nm = 0.3,
                                                .offers_position = true,
                                                .status_period_s = 0.001,
                                                .lost_after_s = 0.004},
                                     host::VescEmulatorConfig{.status_period_ns = 1'000'000});
}

// What is done to a joint that is up and homed; afterwards its drive is well and powered.
template <class Joint>
struct Loss {
  const char* name;
  std::function<void(Joint&)> happen;
};

template <class Joint>
void bring_up_and_home(Joint& joint) {
  joint.ticks(2500);
  ASSERT_EQ(joint.sample().status, kDeviceNotReady) << joint.device().trouble().trouble.what;
  joint.home();
  ASSERT_EQ(joint.sample().status, kDeviceOk) << joint.device().trouble().trouble.what;
  joint.move(0.3);
  ASSERT_NEAR(joint.sample().position[0], 0.3, 0.02);
}

template <class Joint>
void expect_only_homing_brings_it_back(Joint& joint, const char* name) {
  SCOPED_TRACE(name);
  joint.expect_lost();
  for (int i = 0; i < 3; ++i) {
    joint.reset();
    joint.expect_lost();
    EXPECT_EQ(joint.sample().status, kDeviceNotReady) << joint.device().trouble().trouble.what;
  }
  joint.emulator().shaft().velocity_rad_per_s = 0.0;
  joint.home();
  EXPECT_EQ(joint.sample().status, kDeviceOk) << joint.device().trouble().trouble.what;
  EXPECT_NEAR(joint.sample().position[0], 0.0, 0.02);
  EXPECT_TRUE(joint.device().lost_reference().joint.empty());
}

template <class Joint>
void unplug(Joint& joint, int ticks) {
  joint.emulator().set_fault(EmulatorFault::unplugged);
  joint.ticks(ticks / 2);
  joint.move(0.17);
  joint.ticks(ticks / 2);
  joint.emulator().set_fault(EmulatorFault::none);
  joint.ticks(500);
}

template <class Joint>
std::vector<Loss<Joint>> common_losses() {
  return {
      {"power lost and back", [](Joint& joint) { unplug(joint, 500); }},
      {"restart without an error",
       [](Joint& joint) {
         joint.emulator().set_fault(EmulatorFault::power_cycled);
         joint.ticks(600);
       }},
      {"silent, then back",
       [](Joint& joint) {
         joint.emulator().set_fault(EmulatorFault::silent);
         joint.ticks(100);
         joint.emulator().set_fault(EmulatorFault::none);
         joint.ticks(100);
       }},
      {"bus down, then up",
       [](Joint& joint) {
         joint.host().set_link_up(false);
         joint.ticks(100);
         joint.host().set_link_up(true);
         joint.ticks(100);
       }},
      {"a fault of the drive, then power lost and back",
       [](Joint& joint) {
         joint.emulator().set_fault(EmulatorFault::erroring);
         joint.ticks(100);
         EXPECT_EQ(joint.sample().status & kDeviceReferenceLost, 0U) << "not yet";
         unplug(joint, 500);
       }},
      {"a fault of the drive, then a restart while the reset brings it up",
       [](Joint& joint) {
         joint.emulator().set_fault(EmulatorFault::erroring);
         joint.ticks(100);
         joint.emulator().set_fault(EmulatorFault::none);
         joint.ticks(700);
         joint.device().clear_faults();
         joint.ticks(5);
         joint.emulator().set_fault(EmulatorFault::power_cycled);
         joint.ticks(600);
       }},
      {"power lost while the power stage is off after a fault of the controller",
       [](Joint& joint) {
         joint.command() = {.power_off = true};
         joint.ticks(100);
         EXPECT_EQ(joint.sample().status, kDeviceOk);
         unplug(joint, 500);
         joint.command() = {};
       }},
  };
}

class ODriveReference : public ::testing::TestWithParam<host::ODriveFirmware> {};

INSTANTIATE_TEST_SUITE_P(Firmware, ODriveReference,
                         ::testing::Values(host::ODriveFirmware::v0_5_2,
                                           host::ODriveFirmware::v0_5_6,
                                           host::ODriveFirmware::v0_6));

TEST_P(ODriveReference, IsGoneAfterEveryKindOfLossUntilTheJointIsHomed) {
  for (const Loss<ODriveJoint>& loss : common_losses<ODriveJoint>()) {
    SCOPED_TRACE(loss.name);
    const auto joint = odrive_joint(GetParam());
    bring_up_and_home(*joint);
    loss.happen(*joint);
    expect_only_homing_brings_it_back(*joint, loss.name);
  }
}

// An emergency stop that cuts the supply: the drive says so, dies, and boots where the arm is then.
TEST_P(ODriveReference, IsGoneAfterAnUnderVoltageAtOnceOnceItIsTold) {
  const auto joint = odrive_joint(GetParam());
  bring_up_and_home(*joint);
  if (GetParam() == host::ODriveFirmware::v0_6) {
    joint->emulator().raise(0x200);
  } else {
    joint->emulator().raise_motor_error(0x100'0000);
  }
  joint->ticks(150);
  EXPECT_NE(joint->sample().status & kDeviceReferenceLost, 0U);
  EXPECT_NE(joint->sample().status & kDeviceDriveFault, 0U);
  unplug(*joint, 500);
  expect_only_homing_brings_it_back(*joint, "under-voltage");
}

TEST_P(ODriveReference, StaysThroughAFaultThatLeavesThePositionAlone) {
  const auto joint = odrive_joint(GetParam());
  bring_up_and_home(*joint);
  joint->emulator().set_fault(EmulatorFault::erroring);
  joint->ticks(200);
  EXPECT_NE(joint->sample().status & kDeviceDriveFault, 0U);
  joint->move(0.2);
  joint->emulator().set_fault(EmulatorFault::none);
  joint->ticks(100);
  joint->reset();
  EXPECT_EQ(joint->sample().status, kDeviceOk) << joint->device().trouble().trouble.what;
  EXPECT_NEAR(joint->sample().position[0], 0.5, 0.02);
}

TEST_P(ODriveReference, IsGoneWhenClosedLoopIsLeftWithoutAnError) {
  const auto joint = odrive_joint(GetParam());
  bring_up_and_home(*joint);
  joint->emulator().drop_to_idle();
  joint->ticks(100);
  EXPECT_NE(joint->sample().status & kDeviceReferenceLost, 0U)
      << "closed loop left without an error is what a restart looks like";
}

TEST_P(ODriveReference, PowerGoesOffAfterAFaultOfTheControllerAndComesBack) {
  const auto joint = odrive_joint(GetParam());
  bring_up_and_home(*joint);
  EXPECT_EQ(joint->emulator().axis_state(), 8U);
  joint->command() = {.power_off = true};
  joint->ticks(5);
  EXPECT_EQ(joint->emulator().axis_state(), 1U);
  joint->move(0.1);
  EXPECT_EQ(joint->sample().status, kDeviceOk);
  EXPECT_NEAR(joint->sample().position[0], 0.4, 0.02);
  joint->command() = {};
  joint->ticks(2);
  EXPECT_EQ(joint->sample().status, kDeviceNotReady);
  joint->ticks(1000);
  EXPECT_EQ(joint->sample().status, kDeviceOk) << joint->device().trouble().trouble.what;
  EXPECT_EQ(joint->emulator().axis_state(), 8U);
}

TEST_P(ODriveReference, MeasuredTorqueReachesTheJoint) {
  const auto joint = odrive_joint(GetParam());
  bring_up_and_home(*joint);
  joint->command() = {.effort = {0.5}, .enable = true};
  joint->ticks(40);
  EXPECT_EQ(joint->sample().effort_known, 1U);
  EXPECT_NEAR(joint->sample().effort[0], 0.5, 1e-6);
  joint->command() = {.power_off = true};
  joint->ticks(5);
  EXPECT_EQ(joint->sample().effort_known, 0U);
}

TEST(ODriveWatchdog, DriveWhoseWatchdogIsOffIsRefusedUnlessItsOwnerAcceptsIt) {
  for (const auto firmware : {host::ODriveFirmware::v0_5_6, host::ODriveFirmware::v0_6}) {
    for (const bool accepted : {false, true}) {
      ODriveJoint joint(
          ODriveConfig{.unproven_watchdog = accepted, .heartbeat_lost_s = 0.035},
          host::ODriveEmulatorConfig{.firmware = firmware, .heartbeat_ms = 10, .watchdog_s = 0.0});
      joint.ticks(1500);
      EXPECT_EQ((joint.sample().status & kDeviceDriveFault) != 0, !accepted);
      if (!accepted) {
        EXPECT_NE(joint.device().trouble().trouble.what.find("watchdog does not stop"),
                  std::string_view::npos);
        EXPECT_EQ(joint.emulator().axis_state(), 1U);
      }
    }
  }
}

// On 0.5 every frame feeds the watchdog: beside another program's questions a dead host's torque
// would stay.
TEST(ODriveWatchdog, WatchdogThatAnotherProgramFeedsIsRefused) {
  const auto joint = odrive_joint(host::ODriveFirmware::v0_5_6);
  hal::SimulatedCanBus stranger(joint->network());
  for (int i = 0; i < 150; ++i) {
    (void)stranger.send({.id = 0x17, .remote = true});
    joint->ticks(10);
  }
  EXPECT_NE(joint->sample().status & kDeviceDriveFault, 0U);
  EXPECT_NE(joint->device().trouble().trouble.remedy.find("no other program"),
            std::string_view::npos);
}

TEST(ODriveWatchdog, SlowWatchdogIsRefusedToo) {
  ODriveJoint joint(ODriveConfig{.heartbeat_lost_s = 0.035},
                    host::ODriveEmulatorConfig{.heartbeat_ms = 10, .watchdog_s = 0.2});
  joint.ticks(1500);
  EXPECT_NE(joint.sample().status & kDeviceDriveFault, 0U);
}

TEST(VescReference, IsGoneAfterEveryKindOfLossUntilTheJointIsHomed) {
  for (const Loss<VescJoint>& loss : common_losses<VescJoint>()) {
    SCOPED_TRACE(loss.name);
    const auto joint = vesc_joint();
    bring_up_and_home(*joint);
    loss.happen(*joint);
    expect_only_homing_brings_it_back(*joint, loss.name);
  }
}

TEST(VescReference, IsGoneAfterAnUnderVoltage) {
  const auto joint = vesc_joint();
  bring_up_and_home(*joint);
  joint->emulator().set_fault_code(2);
  joint->ticks(100);
  EXPECT_NE(joint->sample().status & kDeviceReferenceLost, 0U);
  joint->emulator().set_fault_code(0);
  joint->ticks(100);
  expect_only_homing_brings_it_back(*joint, "under-voltage");
}

TEST(VescWatchdog, VescWhoseTimeoutIsAsDeliveredIsRefusedUnlessItsOwnerAcceptsIt) {
  for (const bool accepted : {false, true}) {
    VescJoint joint(
        VescConfig{.torque_constant_Nm_per_A = 0.03,
                   .max_torque_Nm = 0.3,
                   .unproven_watchdog = accepted,
                   .status_period_s = 0.001,
                   .lost_after_s = 0.004},
        host::VescEmulatorConfig{.timeout_ns = 1'000'000'000, .status_period_ns = 1'000'000});
    joint.ticks(500);
    EXPECT_EQ((joint.sample().status & kDeviceDriveFault) != 0, !accepted)
        << joint.device().trouble().trouble.what;
  }
}

}  // namespace
}  // namespace tactus::drivers
