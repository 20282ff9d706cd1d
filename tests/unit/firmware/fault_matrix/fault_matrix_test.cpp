// Every fault in every mode: what latches it, how soon the torque is gone, and the way back.
//
// Those of the program around the controller (a signal, a dead writer thread, a telemetry reader
// that is stuck, a commander that was killed) are in the rig, where there is such a program.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <string>

#include "tests/support/rows.h"
#include "tests/unit/firmware/fault_matrix/faulty_rig.h"

namespace tactus::firmware {
namespace {

constexpr std::uint8_t kInit = 1U << static_cast<unsigned>(Mode::init);
constexpr std::uint8_t kHoming = 1U << static_cast<unsigned>(Mode::homing);
constexpr std::uint8_t kReady = 1U << static_cast<unsigned>(Mode::ready);
constexpr std::uint8_t kActive = 1U << static_cast<unsigned>(Mode::active);
constexpr std::uint8_t kFault = 1U << static_cast<unsigned>(Mode::fault);
constexpr std::uint8_t kEvery = kInit | kHoming | kReady | kActive | kFault;
constexpr std::uint8_t kReferenced = kInit | kReady | kActive | kFault;
constexpr std::uint8_t kLocated = kReady | kActive | kFault;

template <std::uint32_t kStatus>
void report(FaultyRig& rig, int /*tick*/) {
  rig.device.sample.status |= kStatus;
}

template <std::uint32_t kStatus>
void fail_the_write(FaultyRig& rig, int /*tick*/) {
  rig.device.write_status = kStatus;
}

template <LoopReport kReport>
void hold_the_loop_up(FaultyRig& rig, int /*tick*/) {
  rig.controller().note_loop(kReport);
}

void age_the_sample(FaultyRig& rig, int tick) {
  rig.device.sample.age_us = 6000U + 1000U * static_cast<std::uint32_t>(tick);
}

void read_nan(FaultyRig& rig, int /*tick*/) {
  rig.device.sample.position[2] = std::numeric_limits<double>::quiet_NaN();
}

void read_infinite_velocity(FaultyRig& rig, int /*tick*/) {
  rig.device.sample.velocity[0] = -std::numeric_limits<double>::infinity();
}

void freeze(FaultyRig& rig, int /*tick*/) {
  rig.device.sample.velocity[0] = 1.0;
}

void jump(FaultyRig& rig, int tick) {
  rig.device.sample.position[0] = tick == 0 ? 0.0 : 0.3;
}

void leave_the_joints_range(FaultyRig& rig, int tick) {
  rig.device.sample.position[0] = 0.05 * tick;
}

void go_through_the_wall(FaultyRig& rig, int tick) {
  rig.device.sample.position[0] = 0.05 * tick;
}

void race(FaultyRig& rig, int tick) {
  rig.device.sample.position[0] = 0.006 * tick;
  rig.device.sample.velocity[0] = 6.0;
}

// A force that should push out of the floor pushes into it, faster and faster.
void flip_the_sign(FaultyRig& rig, int tick) {
  rig.device.sample.position[1] = -0.002 - 0.003 * tick;
  rig.device.sample.velocity[1] = -3.0;
}

// The floor slides away under the tool in small steps while the reading stays.
void block(FaultyRig& rig, int tick) {
  rig.device.sample.position[1] = tick == 0 ? 0.0005 : -0.004;
}

// The tool goes in with no force yet and comes out with all of it, like a position that comes late
// by some ticks.
void pump(FaultyRig& rig, int tick) {
  rig.device.sample.position[1] = tick % 10 < 5 ? -0.03 : 0.001;
}

// The depth and so the floor's force grow by a twentieth each tick, as behind a reversed motor.
void feed(FaultyRig& rig, int tick) {
  const double depth_m = 0.002 * std::pow(1.06, tick);
  rig.device.sample.position[1] = -depth_m;
  rig.device.sample.velocity[1] = -0.06 * depth_m * 1000.0;
}

// The drive of the joint that holds the floor's 1 N measures the reverse of it, twice as much.
void measure_another_effort(FaultyRig& rig, int /*tick*/) {
  rig.device.sample.effort[1] = -2.0;
  rig.device.sample.effort_known = 0b010;
  rig.device.sample.effort_is_new = 0b010;
}

constexpr LoopReport kLateReport{.status = kLoopLate, .missed_ticks = 0};
constexpr LoopReport kOverrunReport{.status = kLoopOnTime, .missed_ticks = 10};
constexpr LoopReport kWatchdogReport{.status = kLoopWatchdogLost, .missed_ticks = 0};
constexpr LoopReport kCrashReport{.status = kLoopHelperCrashed, .missed_ticks = 0};
constexpr LoopReport kLineReport{.status = kLoopLineLost, .missed_ticks = 0};

constexpr auto kFaults = std::to_array<MatrixFault>({
    {"drive silent", kFaultStaleSamples, kEvery, 3, report<drivers::kDeviceStale>},
    {"USB short packets", kFaultStaleSamples, kEvery, 3, age_the_sample},
    {"drive reports error", kFaultDrive, kEvery, 1, report<drivers::kDeviceDriveFault>},
    {"bus off", kFaultDeviceLost, kEvery, 1, report<drivers::kDeviceLost>},
    {"USB unplugged in flight", kFaultDeviceLost, kEvery, 1, fail_the_write<drivers::kDeviceLost>},
    {"drive refuses the command", kFaultDrive, kEvery, 1,
     fail_the_write<drivers::kDeviceDriveFault>},
    {"GPIO chip gone", kFaultDeviceLost, kEvery, 1,
     report<drivers::kDeviceLost | drivers::kDeviceStale>},
    {"index lost", kFaultEncoder, kEvery, 1, report<drivers::kDeviceEncoderFault>},
    {"e-stop pressed", kFaultEmergencyStop, kEvery, 1, report<drivers::kDeviceEmergencyStop>},
    {"power stage over temperature", kFaultOverTemperature, kEvery, 1,
     report<drivers::kDeviceTooHot>},
    {"reference lost", kFaultReferenceLost, kActive, 1, report<drivers::kDeviceNotReady>},
    {"encoder's zero may have moved", kFaultReferenceLost, kEvery, 1,
     report<drivers::kDeviceReferenceLost>},
    {"operator stops", kFaultOperatorStop, kEvery, 1, report<drivers::kDeviceOk>, Request::estop},
    {"late ticks", kFaultLateTicks, kEvery, 3, hold_the_loop_up<kLateReport>},
    {"tick overrun", kFaultTickOverrun, kEvery, 1, hold_the_loop_up<kOverrunReport>},
    {"watchdog output gone", kFaultWatchdog, kEvery, 1, hold_the_loop_up<kWatchdogReport>},
    {"SIGSEGV in a thread beside the loop", kFaultHelperCrashed, kEvery, 1,
     hold_the_loop_up<kCrashReport>},
    {"supervising host silent", kFaultLineLost, kEvery, 1, hold_the_loop_up<kLineReport>},
    {"non-finite pose", kFaultJointNotFinite, kEvery, 1, read_nan},
    {"non-finite velocity", kFaultJointNotFinite, kEvery, 1, read_infinite_velocity},
    {"encoder stuck", kFaultEncoderFrozen, kLocated, 52, freeze},
    {"encoder jumping", kFaultEncoderJump, kLocated, 1, jump},
    {"encoder sign-flipped", kFaultMotionWithoutTorque, kLocated, 90, flip_the_sign},
    {"joint out of range", kFaultJointLimit, kReferenced, 41, leave_the_joints_range},
    {"through a wall", kFaultWorkspace, kLocated, 21, go_through_the_wall},
    {"overspeed", kFaultOverspeed, kLocated, 1, race},
    {"motor or joint blocked", kFaultTorqueWithoutMotion, kActive, 510, block},
    {"motor reversed", kFaultMotorReversed, kActive, 40, feed},
    {"drive measures another torque", kFaultEffortMismatch, kActive, 40, measure_another_effort},
    {"surface gives energy", kFaultNotPassive, kActive, 400, pump},
});
static_assert(kFaults.size() >= 20);

std::string title(const MatrixFault& fault, Mode mode) {
  return std::string(fault.name) + " in " + std::string(mode_name(mode));
}

TEST(FaultMatrix, EveryFaultInEveryModeEndsInZeroTorqueALatchedCodeAndAWayBack) {
  static FaultyRig rig;
  for (const bool measures : {false, true}) {
    rig.device.measures_effort = measures;
    for (const MatrixFault& fault : kFaults) {
      for (std::size_t mode = 0; mode < kModeCount; ++mode) {
        if (measures && !testing::is_taken()) {
          continue;
        }
        EXPECT_EQ(check_cell(rig, fault, static_cast<Mode>(mode), kNoFault), "")
            << title(fault, static_cast<Mode>(mode)) << (measures ? ", effort measured" : "");
      }
    }
  }
}

// Counts the ticks from the first one with the fault, in `active`, to zero torque. More than twice
// the row's ticks means never.
int ticks_to_zero_torque(FaultyRig& rig, const MatrixFault& fault) {
  if (!rig.enter(Mode::active, kNoFault)) {
    return -1;
  }
  rig.heal();
  int ticks = 0;
  while (rig.has_torque() && ticks <= 2 * fault.ticks) {
    fault.inject(rig, ticks);
    rig.tick(fault.request);
    ++ticks;
  }
  return ticks;
}

TEST(FaultMatrix, TorqueIsGoneWithinTwoTicksOfTheFirstOneWithTheFaultCertain) {
  static FaultyRig rig;
  std::puts("ticks of 1 ms to zero torque, without and with drives that measure it");
  for (const MatrixFault& fault : kFaults) {
    rig.device.measures_effort = false;
    const int plain = ticks_to_zero_torque(rig, fault);
    rig.device.measures_effort = true;
    const int measured = ticks_to_zero_torque(rig, fault);
    std::printf("  %-36s %-24s %4d %4d\n", std::string(fault.name).c_str(),
                std::string(fault_name(fault.bit)).c_str(), plain, measured);
    for (const int ticks : {plain, measured}) {
      EXPECT_GT(ticks, 0) << fault.name;
      EXPECT_LE(ticks, fault.ticks + 1) << fault.name;
    }
  }
}

// Silence for one guard at a time: its cells fail and no others.
TEST(FaultMatrix, WithoutAGuardExactlyItsCellsFail) {
  static FaultyRig rig;
  std::set<std::uint64_t> guards;
  for (const MatrixFault& fault : kFaults) {
    guards.insert(fault.bit);
  }
  for (const std::uint64_t off : guards) {
    if (!testing::is_taken()) {
      continue;
    }
    for (const MatrixFault& fault : kFaults) {
      for (std::size_t mode = 0; mode < kModeCount; ++mode) {
        const bool raised = (fault.modes >> mode & 1U) != 0;
        const bool fails = !check_cell(rig, fault, static_cast<Mode>(mode), off).empty();
        EXPECT_EQ(fails, fault.bit == off && raised)
            << title(fault, static_cast<Mode>(mode)) << " without "
            << fault_name(static_cast<FaultBits>(off));
      }
    }
  }
}

// The arm stands where it was under torque, to the count: its effort is gone because of the stop.
TEST(FaultMatrix, AnArmThatStandsStillAfterAStopUnderTorqueCanBeReset) {
  static FaultyRig rig;
  ASSERT_TRUE(rig.enter(Mode::active, kNoFault));
  rig.heal();
  rig.tick();
  rig.tick(Request::estop);
  for (int tick = 0; tick < 2000; ++tick) {
    rig.tick();
    ASSERT_EQ(rig.record().faults, kFaultOperatorStop) << tick;
  }
  rig.tick(Request::reset);
  EXPECT_EQ(rig.record().mode, Mode::init);
}

TEST(FaultMatrix, AFaultOfOneMotorNamesItsJointUntilTheReset) {
  static FaultyRig rig;
  for (auto* const inject : {feed, measure_another_effort}) {
    ASSERT_TRUE(rig.enter(Mode::active, kNoFault));
    rig.heal();
    for (int tick = 0; tick <= 40; ++tick) {
      inject(rig, tick);
      rig.tick();
    }
    EXPECT_EQ(rig.record().fault_joint, 2U);
    rig.heal();
    rig.tick();
    EXPECT_EQ(rig.record().fault_joint, 2U);
    rig.tick(Request::reset);
    EXPECT_EQ(rig.record().fault_joint, 0U);
  }
}

// Injects a fault into a device beside a companion. Returns what is wrong with the companion's
// reaction in any tick, or an empty text.
std::string check_companion(FaultyRig& rig, const MatrixFault& fault, Mode mode, OnFault on_fault) {
  // A rig that is in mode `fault` already has got there by an operator's stop.
  const bool stops =
      on_fault == OnFault::all || fault.bit == kFaultOperatorStop || mode == Mode::fault;
  if (!rig.enter(mode, kNoFault)) {
    return "the mode was not reached";
  }
  rig.heal();
  for (int tick = 0; tick <= fault.ticks; ++tick) {
    fault.inject(rig, tick);
    rig.tick(fault.request);
    const TelemetryRecord& record = rig.record(1);
    const bool has_own_fault = (record.faults & ~kFaultOtherDevice) != 0;  // one of the loop
    if (stops && rig.record().faults != 0) {
      if (rig.companion.has_torque() || record.mode != Mode::fault) {
        return "the companion goes on";
      }
      if (!has_own_fault && (record.faults != kFaultOtherDevice || record.fault_device != 1)) {
        return "the companion does not name the device";
      }
    } else if (!has_own_fault && !rig.companion.has_torque()) {
      return "the companion stops";
    }
  }
  return "";
}

TEST(FaultMatrix, EveryFaultOfADeviceInEveryModeTakesTheForceFromTheOther) {
  static FaultyRig rig(2, OnFault::all);
  for (const MatrixFault& fault : kFaults) {
    for (std::size_t mode = 0; mode < kModeCount; ++mode) {
      EXPECT_EQ(check_companion(rig, fault, static_cast<Mode>(mode), OnFault::all), "")
          << title(fault, static_cast<Mode>(mode));
    }
  }
}

TEST(FaultMatrix, AFaultOfADeviceThatStopsOnlyItselfLeavesTheOtherItsForce) {
  static FaultyRig rig(2, OnFault::own);
  for (const MatrixFault& fault : kFaults) {
    for (std::size_t mode = 0; mode < kModeCount; ++mode) {
      EXPECT_EQ(check_companion(rig, fault, static_cast<Mode>(mode), OnFault::own), "")
          << title(fault, static_cast<Mode>(mode));
    }
  }
}

TEST(FaultMatrix, ADeviceHasNoForceBesideAFaultUntilBothAreReset) {
  static FaultyRig rig(2, OnFault::all);
  ASSERT_TRUE(rig.enter(Mode::active, kNoFault));
  rig.heal();
  rig.tick(Request::estop);
  rig.tick();
  for (const Request request : {Request::reset, Request::home, Request::enable}) {
    rig.tick(Request::none, request);
    rig.tick();
    EXPECT_EQ(rig.record(1).mode, Mode::fault);
    EXPECT_EQ(rig.record(1).faults, kFaultOtherDevice);
    EXPECT_FALSE(rig.companion.has_torque());
  }
  rig.tick(Request::reset, Request::reset);
  EXPECT_EQ(rig.record(0).mode, Mode::init);
  EXPECT_EQ(rig.record(1).mode, Mode::init);
  EXPECT_EQ(rig.record(1).fault_device, 0U);
}

TEST(FaultMatrix, ASwitchedOffGuardIsSaidInEveryTick) {
  static FaultyRig rig;
  ASSERT_TRUE(rig.enter(Mode::active, kFaultOverspeed));
  EXPECT_EQ(rig.record().limits & kLimitGuardsOff, kLimitGuardsOff);
}

}  // namespace
}  // namespace tactus::firmware
