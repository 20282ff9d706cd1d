// A joint in a known pose on one emulated CAN drive, through a ComposedDevice, and the ways in
// which its reference may be lost.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "drivers/composition/can_board.h"
#include "drivers/composition/composed_device.h"
#include "hal/simulated/can_bus.h"
#include "hal/simulated/can_network.h"
#include "hal/simulated/clock.h"
#include "host_tools/emulators/can_emulator.h"
#include "tests/support/share.h"

namespace tactus::drivers {

// One joint in a known pose at 0, on one drive.
template <class Driver, class Emulator>
class OneJoint final : private hal::SimulatedEventSource {
 public:
  static constexpr hal::TimeNs kTick_ns = 1'000'000;
  static constexpr double kRatio = 10.0;

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
  // Resets and waits until the drive is up, as an operator does before homing.
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

// An event that makes a joint that is up and homed lose its reference. Afterwards its drive is well
// and powered.
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
  for (int i = 0; i < testing::part_of(3); ++i) {
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
  joint.emulator().set_fault(host::EmulatorFault::unplugged);
  joint.ticks(ticks / 2);
  joint.move(0.17);
  joint.ticks(ticks / 2);
  joint.emulator().set_fault(host::EmulatorFault::none);
  joint.ticks(500);
}

template <class Joint>
std::vector<Loss<Joint>> common_losses() {
  return {
      {"power lost and back", [](Joint& joint) { unplug(joint, 500); }},
      {"restart without an error",
       [](Joint& joint) {
         joint.emulator().set_fault(host::EmulatorFault::power_cycled);
         joint.ticks(600);
       }},
      {"silent, then back",
       [](Joint& joint) {
         joint.emulator().set_fault(host::EmulatorFault::silent);
         joint.ticks(100);
         joint.emulator().set_fault(host::EmulatorFault::none);
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
         joint.emulator().set_fault(host::EmulatorFault::erroring);
         joint.ticks(100);
         EXPECT_EQ(joint.sample().status & kDeviceReferenceLost, 0U) << "not yet";
         unplug(joint, 500);
       }},
      {"a fault of the drive, then a restart while the reset brings it up",
       [](Joint& joint) {
         joint.emulator().set_fault(host::EmulatorFault::erroring);
         joint.ticks(100);
         joint.emulator().set_fault(host::EmulatorFault::none);
         joint.ticks(700);
         joint.device().clear_faults();
         joint.ticks(5);
         joint.emulator().set_fault(host::EmulatorFault::power_cycled);
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

}  // namespace tactus::drivers
