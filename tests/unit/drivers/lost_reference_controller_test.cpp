// An emergency stop that cuts a drive's supply, from the controller to the emulated ODrive: the arm
// is moved without power, and the drive counts from 0 when it boots.

#include <gtest/gtest.h>

#include <memory>

#include "drivers/composition/can_board.h"
#include "drivers/composition/composed_device.h"
#include "drivers/odrive_can/odrive_can.h"
#include "firmware/control/controller.h"
#include "firmware/control/run_tick.h"
#include "firmware/safety/faults.h"
#include "hal/simulated/can_bus.h"
#include "hal/simulated/can_network.h"
#include "hal/simulated/clock.h"
#include "host_tools/emulators/odrive_emulator.h"

namespace tactus::drivers {
namespace {

using firmware::Mode;
using firmware::Request;
using host::EmulatorFault;
using host::ODriveEmulator;

constexpr double kPaddleRatio = 10.0;

class PaddleOnODrive : public ::testing::Test {
 protected:
  PaddleOnODrive() {
    EXPECT_TRUE(board_.add(ODriveCan({.max_torque_Nm = 1.0, .heartbeat_lost_s = 0.035})));
    EXPECT_TRUE(device_.add_board(BoardRef(board_)));
    EXPECT_TRUE(device_.add_joint(
        {.name = "paddle",
         .transmission = {.motor_ratio = kPaddleRatio, .encoder_ratio = kPaddleRatio},
         .reference = {.kind = ReferenceKind::known_pose},
         .max_torque_Nm = 1.0}));
    EXPECT_TRUE(controller_->configure(firmware::hapkit_config()));
    device_.start();
    run(1500);
    ask(Request::home);
    run(600);
    ask(Request::enable);
    run(100);
    EXPECT_EQ(controller_->mode(), Mode::active);
    move(0.3);
    EXPECT_NEAR(said_rad(), 0.3, 0.01);
  }

  void ask(Request request) {
    firmware::run_tick(*controller_, device_, request);
    for (int i = 0; i < 10; ++i) {
      clock_.advance_by(100'000);
      drive_.run(clock_.now_ns());
    }
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      ask(Request::none);
    }
  }
  void move(double joint_rad) {
    constexpr int kSteps = 500;
    for (int i = 0; i < kSteps; ++i) {
      drive_.shaft().position_rad += kPaddleRatio * joint_rad / kSteps;
      ask(Request::none);
    }
  }
  // Twice: the first may still see what the last write told.
  void reset() {
    ask(Request::reset);
    run(1500);
    ask(Request::reset);
    run(1500);
  }
  void lose_power_and_move_on() {
    drive_.set_fault(EmulatorFault::unplugged);
    run(500);
    move(0.1);
    drive_.set_fault(EmulatorFault::none);
    run(500);
  }
  // Whatever the operator asks for but a homing, the controller is not active.
  void expect_not_active_until_homed() {
    for (int i = 0; i < 3; ++i) {
      reset();
      ask(Request::enable);
      run(10);
      EXPECT_NE(controller_->mode(), Mode::active);
      EXPECT_EQ(drive_.shaft().torque_Nm, 0.0);
    }
    EXPECT_EQ(controller_->mode(), Mode::init);
    EXPECT_EQ(device_.lost_reference().joint, "paddle");
    drive_.shaft().position_rad = 0.0;  // the operator brings it to its pose; the drive sees a jump
    drive_.set_fault(EmulatorFault::power_cycled);
    run(800);
    reset();
    ask(Request::home);
    run(600);
    ask(Request::enable);
    run(100);
    EXPECT_EQ(controller_->mode(), Mode::active)
        << faults() << ' ' << device_.trouble().trouble.what;
    EXPECT_NEAR(said_rad(), 0.0, 0.01);
  }
  [[nodiscard]] double said_rad() const { return controller_->record().joint_position[0]; }
  [[nodiscard]] std::uint64_t faults() const { return controller_->record().faults; }

  hal::SimulatedClock clock_;
  hal::SimulatedCanNetwork network_{clock_};
  hal::SimulatedCanBus host_{network_};
  hal::SimulatedCanBus node_{network_};
  CanBoard<ODriveCan> board_{host_, clock_};
  ODriveEmulator drive_{node_, 1, {.heartbeat_ms = 10}};
  ComposedDevice device_{clock_, 300'000};
  std::unique_ptr<firmware::Controller> controller_ = std::make_unique<firmware::Controller>();
};

TEST_F(PaddleOnODrive, UnderVoltageThenDeadThenBackIsNotActiveUntilHomed) {
  drive_.raise(0x200);
  run(20);
  EXPECT_NE(faults() & firmware::kFaultDrive, 0U);
  EXPECT_NE(faults() & firmware::kFaultReferenceLost, 0U);
  lose_power_and_move_on();
  expect_not_active_until_homed();
}

// The fault that comes first leaves the position alone; the power goes later.
TEST_F(PaddleOnODrive, DriveFaultThenDeadThenBackIsNotActiveUntilHomed) {
  drive_.raise(0x1000);
  run(20);
  EXPECT_NE(faults() & firmware::kFaultDrive, 0U);
  EXPECT_EQ(faults() & firmware::kFaultReferenceLost, 0U);
  lose_power_and_move_on();
  EXPECT_NE(faults() & firmware::kFaultReferenceLost, 0U);
  expect_not_active_until_homed();
}

TEST_F(PaddleOnODrive, StopOfTheOperatorThenPowerCycledIsNotActiveUntilHomed) {
  ask(Request::estop);
  run(20);
  EXPECT_EQ(drive_.axis_state(), 1U) << "the power stage is off";
  EXPECT_EQ(faults(), firmware::kFaultOperatorStop);
  drive_.set_fault(EmulatorFault::power_cycled);
  run(1000);
  EXPECT_NE(faults() & firmware::kFaultReferenceLost, 0U);
  expect_not_active_until_homed();
}

// Nothing was lost: after the reset the drive comes up and the joint is where it was said to be.
TEST_F(PaddleOnODrive, StopOfTheOperatorAloneNeedsNoHoming) {
  ask(Request::estop);
  run(20);
  move(-0.1);
  ask(Request::reset);
  run(1000);
  EXPECT_NEAR(said_rad(), 0.2, 0.01);
  EXPECT_TRUE(device_.lost_reference().joint.empty());
  ask(Request::home);
  run(50);
  ask(Request::enable);
  run(100);
  EXPECT_EQ(controller_->mode(), Mode::active);
}

}  // namespace
}  // namespace tactus::drivers
