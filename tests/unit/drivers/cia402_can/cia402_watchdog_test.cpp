// The proof of the drive's watchdog at each bring-up: what counts as one, and what does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/cia402_can/cia402_can.h"
#include "host_tools/emulators/cia402_emulator.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {
namespace {

using host::EmulatorFault;
using WatchdogRig = CanRig<Cia402Can, host::Cia402Emulator>;

constexpr hal::TimeNs kUp_ns = 1000 * kMs;
constexpr const char* kHeartbeat = " 77F#05";  // of the host, for node 1

WatchdogRig one_watched(const host::Cia402EmulatorConfig& drive = {},
                        const Cia402Config& driver = {.max_torque_Nm = 0.5}) {
  return WatchdogRig({.record = true}, std::vector{driver}, std::vector{drive});
}

double time_s(const std::string& line) {
  return std::stod(line.substr(1));
}

// Returns the times of the log's frames whose text ends in `frame`, s.
std::vector<double> times_s(const std::vector<std::string>& log, std::string_view frame) {
  std::vector<double> times;
  for (const std::string& line : log) {
    if (line.ends_with(frame)) {
      times.push_back(time_s(line));
    }
  }
  return times;
}

double longest_silence_s(const std::vector<std::string>& log) {
  const std::vector<double> times = times_s(log, kHeartbeat);
  double longest_s = 0.0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    longest_s = std::max(longest_s, times[i] - times[i - 1]);
  }
  return longest_s;
}

// Ticks until the drive has power for the proof, and is silent with the host.
void run_into_the_proof(WatchdogRig& rig) {
  ASSERT_GT(rig.run_until(kUp_ns, [&] { return (rig.emulator(0).statusword() & 0x6FU) == 0x27U; }),
            0);
  rig.run(15 * kMs);
  ASSERT_EQ(rig.emulator(0).statusword() & 0x6FU, 0x27U);
}

void expect_refused(WatchdogRig& rig, std::string_view words) {
  EXPECT_LT(rig.run_until_well(kUp_ns), 0);
  EXPECT_EQ(rig.sample(0).status & ~std::uint32_t{kDeviceTooHot}, kDeviceDriveFault);
  EXPECT_NE(rig.board().trouble(0).what.find(words), std::string_view::npos)
      << rig.board().trouble(0).what;
  EXPECT_NE(rig.board().trouble(0).remedy.find("reset"), std::string_view::npos);
  EXPECT_NE(rig.emulator(0).statusword() & 0x6FU, 0x27U) << "it keeps its power";
}

TEST(Cia402Watchdog, TripsAtZeroTorqueBeforeTheAxisIsReady) {
  WatchdogRig rig = one_watched();
  rig.start();
  rig.command_all(0.3);
  const hal::TimeNs passed_ns = rig.run_until_well(kUp_ns);
  ASSERT_GT(passed_ns, 0) << rig.board().trouble(0).what;
  RecordProperty("bring_up_ms", static_cast<int>(passed_ns / kMs));
  EXPECT_EQ(rig.last_torque_ns(0), 0);
  // 'Enable operation' at zero torque, then nothing to the drive until its 8130.
  const std::vector<double> trips = times_s(rig.log(), " 081#3081010000000000");
  const std::vector<double> enables = times_s(rig.log(), " 201#0F000000");
  ASSERT_EQ(trips.size(), 1U);
  ASSERT_FALSE(enables.empty());
  const auto is_before = [&](double time) { return time < trips[0]; };
  EXPECT_GT(std::ranges::count_if(enables, is_before), 0);
  for (const std::string& line : rig.log()) {
    const bool is_to_the_drive = line.contains(" 201#") || line.contains(" 601#") ||
                                 line.contains(" 000#") || line.ends_with(kHeartbeat);
    EXPECT_FALSE(is_to_the_drive && time_s(line) < trips[0] && time_s(line) > trips[0] - 0.014)
        << line;
  }
  EXPECT_GT(longest_silence_s(rig.log()), 0.02);
  EXPECT_LT(longest_silence_s(rig.log()), 0.03);
}

TEST(Cia402Watchdog, ThatNeverTripsIsRefusedUnlessTheOwnerAcceptsIt) {
  for (const bool accepted : {false, true}) {
    WatchdogRig rig =
        one_watched({.has_watchdog = false}, {.max_torque_Nm = 0.5, .unproven_watchdog = accepted});
    rig.start();
    if (accepted) {
      EXPECT_GT(rig.run_until_well(kUp_ns), 0) << rig.board().trouble(0).what;
      EXPECT_LT(longest_silence_s(rig.log()), 0.007);
    } else {
      expect_refused(rig, "does not take the torque away");
      EXPECT_NE(rig.board().trouble(0).remedy.find("unproven_watchdog"), std::string_view::npos);
    }
  }
}

TEST(Cia402Watchdog, ThatTripsTooLateIsRefused) {
  for (const auto& [lag_ns, is_soon] :
       {std::pair{10 * kMs, true}, {30 * kMs, false}, {200 * kMs, false}}) {
    WatchdogRig rig = one_watched({.watchdog_lag_ns = lag_ns});
    rig.start();
    if (is_soon) {
      EXPECT_GT(rig.run_until_well(kUp_ns), 0) << rig.board().trouble(0).what;
    } else {
      expect_refused(rig, "does not take the torque away");
    }
  }
}

// It tells of the silence, and goes on.
TEST(Cia402Watchdog, ThatOnlyReportsIsRefused) {
  WatchdogRig rig = one_watched({.error_behaviour = 1});
  rig.emulator(0).remove_object(0x6007, 0);
  rig.start();
  expect_refused(rig, "does not take the torque away");
  EXPECT_FALSE(times_s(rig.log(), " 081#3081000000000000").empty());
}

// No PDO tells then: the statusword is asked for.
TEST(Cia402Watchdog, DriveThatLeavesOperationalIsAskedWhetherItHasLetGo) {
  for (const bool keeps_power : {false, true}) {
    WatchdogRig rig = one_watched({.keeps_power_unheard = keeps_power});
    rig.emulator(0).remove_object(0x6007, 0);
    rig.start();
    if (keeps_power) {
      expect_refused(rig, "does not take the torque away");
    } else {
      EXPECT_GT(rig.run_until_well(kUp_ns), 0) << rig.board().trouble(0).what;
    }
    EXPECT_FALSE(times_s(rig.log(), " 601#4041600000000000").empty());
  }
}

TEST(Cia402Watchdog, HeartbeatOfAnotherProgramIsFoundOut) {
  WatchdogRig rig = one_watched();
  hal::SimulatedCanBus stranger(rig.network());
  rig.start();
  int tick = 0;
  rig.run(500 * kMs, [&](auto&, auto&) {
    if (++tick % 10 == 0) {
      (void)stranger.send(frame_of("77F#05"));
    }
  });
  expect_refused(rig, "does not take the torque away");
  EXPECT_NE(rig.board().trouble(0).remedy.find("no other program"), std::string_view::npos);
}

TEST(Cia402Watchdog, FaultOfAnotherKindProvesNothing) {
  for (const bool tells : {true, false}) {
    for (const std::uint16_t code : {std::uint16_t{0x2310}, std::uint16_t{0xFF01}}) {
      WatchdogRig rig = one_watched();
      rig.start();
      run_into_the_proof(rig);
      rig.emulator(0).raise_fault(rig.clock().now_ns(), code, tells);
      rig.run(10 * kMs);
      EXPECT_EQ(rig.sample(0).status, kDeviceDriveFault);
      EXPECT_EQ(rig.board().trouble(0).code, code) << rig.board().trouble(0).what;
      rig.board().clear_faults();
      EXPECT_GT(rig.run_until_well(kUp_ns), 0) << rig.board().trouble(0).what;
      EXPECT_EQ(times_s(rig.log(), " 081#3081010000000000").size(), 1U) << "not proven";
    }
  }
}

// An emergency stop takes the power too. 603F:00 still has the code of an earlier silence.
TEST(Cia402Watchdog, EmergencyStopInTheProofProvesNothing) {
  WatchdogRig rig = one_watched();
  rig.start();
  run_into_the_proof(rig);
  rig.emulator(0).set_object(0x603F, 0, 0x8130);
  rig.emulator(0).set_motor_power(false);
  expect_refused(rig, "supply is gone");
  rig.emulator(0).set_motor_power(true);
  rig.board().clear_faults();
  EXPECT_GT(rig.run_until_well(kUp_ns), 0) << rig.board().trouble(0).what;
  EXPECT_EQ(times_s(rig.log(), " 081#3081010000000000").size(), 1U);
}

// A safe torque off that leaves the voltage on looks like this, with 603F:00 as above.
TEST(Cia402Watchdog, PowerThatGoesWithoutAReasonProvesNothing) {
  WatchdogRig rig = one_watched({.has_watchdog = false});
  rig.start();
  run_into_the_proof(rig);
  rig.emulator(0).set_object(0x603F, 0, 0x8130);
  rig.emulator(0).drop_power();
  expect_refused(rig, "does not say why");
}

TEST(Cia402Watchdog, PowerThatGoesWithAnotherMessageIsToldByIt) {
  WatchdogRig rig = one_watched({.has_watchdog = false});
  hal::SimulatedCanBus drive(rig.network());
  rig.start();
  run_into_the_proof(rig);
  ASSERT_TRUE(drive.send(frame_of("081#1043010000000000")));
  rig.emulator(0).drop_power();
  expect_refused(rig, "over-temperature");
}

TEST(Cia402Watchdog, DriveThatIsUnpluggedInTheProofIsLost) {
  WatchdogRig rig = one_watched();
  rig.start();
  run_into_the_proof(rig);
  rig.emulator(0).set_fault(EmulatorFault::unplugged);
  rig.run(100 * kMs);
  EXPECT_EQ(rig.sample(0).status, kDeviceLost) << rig.board().trouble(0).what;
  rig.emulator(0).set_fault(EmulatorFault::none);
  rig.run(100 * kMs);
  rig.board().clear_faults();
  EXPECT_GT(rig.run_until_well(kUp_ns), 0) << rig.board().trouble(0).what;
}

TEST(Cia402Watchdog, MissingPowerIsToldWhenItIsWantedForTheProof) {
  WatchdogRig rig = one_watched({}, {.max_torque_Nm = 0.5, .enable_timeout_s = 0.2});
  rig.start();
  ASSERT_GT(rig.run_until(kUp_ns, [&] { return (rig.emulator(0).statusword() & 0x6FU) == 0x21U; }),
            0);
  rig.emulator(0).set_motor_power(false);
  EXPECT_LT(rig.run_until_well(500 * kMs), 0);
  EXPECT_EQ(rig.sample(0).status, kDeviceDriveFault);
  EXPECT_NE(rig.board().trouble(0).remedy.find("motor power"), std::string_view::npos);
}

TEST(Cia402Watchdog, NothingGetsPowerForTheProofWhileItIsToHaveNone) {
  WatchdogRig rig = one_watched();
  rig.start();
  run_into_the_proof(rig);
  rig.run(2 * kMs, [](auto&, auto& commands) { commands[0] = {.power_off = true}; });
  rig.run(3 * kMs);
  EXPECT_NE(rig.emulator(0).statusword() & 0x6FU, 0x27U);
  bool had_power = false;
  rig.run(6000 * kMs, [&](auto& samples, auto&) {
    EXPECT_EQ(samples[0].status, kDeviceNotReady) << rig.board().trouble(0).what;
    had_power = had_power || (rig.emulator(0).statusword() & 0x6FU) == 0x27U;
  });
  EXPECT_FALSE(had_power);
  rig.run(kMs, [](auto&, auto& commands) { commands[0] = {}; });
  EXPECT_GT(rig.run_until_well(kUp_ns), 0) << rig.board().trouble(0).what;
  EXPECT_EQ(times_s(rig.log(), " 081#3081010000000000").size(), 1U);
}

TEST(Cia402Watchdog, IsProvenOnceUntilTheDriveMayHaveRestarted) {
  WatchdogRig rig = one_watched();
  rig.start();
  ASSERT_GT(rig.run_until_well(kUp_ns), 0);
  const auto trips = [&] { return times_s(rig.log(), " 081#3081010000000000").size(); };
  rig.emulator(0).raise_fault(rig.clock().now_ns(), 0x2310);
  rig.run(10 * kMs);
  rig.board().clear_faults();
  ASSERT_GT(rig.run_until_well(kUp_ns), 0);
  EXPECT_EQ(trips(), 1U);
  rig.emulator(0).set_fault(EmulatorFault::power_cycled);
  rig.run(500 * kMs);
  rig.board().clear_faults();
  ASSERT_GT(rig.run_until_well(kUp_ns), 0);
  EXPECT_EQ(trips(), 2U);
  rig.board().stop();
  rig.run(5 * kMs);
  rig.start();
  ASSERT_GT(rig.run_until_well(kUp_ns), 0);
  EXPECT_GE(trips(), 3U);  // in the pause between, too
}

class Cia402Bus : public ::testing::Test {
 protected:
  static WatchdogRig three(bool second_is_watched) {
    std::vector<Cia402Config> drivers;
    std::vector<host::Cia402EmulatorConfig> drives;
    for (std::uint8_t i = 0; i < 3; ++i) {
      const auto node = static_cast<std::uint8_t>(i + 1);
      drivers.push_back({.node = node, .leads_bus = i == 0, .max_torque_Nm = 0.2});
      drives.push_back({.node = node, .has_watchdog = i != 1 || second_is_watched});
    }
    return WatchdogRig({.record = true}, drivers, drives);
  }
};

TEST_F(Cia402Bus, EveryDriveIsProvenAndTheOneWithoutAWatchdogIsNamed) {
  WatchdogRig well = three(true);
  well.start();
  ASSERT_GT(well.run_until_well(kUp_ns), 0);
  for (const char* trip :
       {" 081#3081010000000000", " 082#3081010000000000", " 083#3081010000000000"}) {
    EXPECT_EQ(times_s(well.log(), trip).size(), 1U) << trip;
  }
  WatchdogRig ill = three(false);
  ill.start();
  ill.run(kUp_ns);
  EXPECT_EQ(ill.sample(0).status, kDeviceOk);
  EXPECT_EQ(ill.sample(1).status, kDeviceDriveFault);
  EXPECT_EQ(ill.sample(2).status, kDeviceOk);
}

// The others push on, in peace.
TEST_F(Cia402Bus, DriveThatComesBackIsProvenWhileTheOthersPush) {
  WatchdogRig rig = three(true);
  for (std::size_t i = 0; i < 3; ++i) {
    rig.rotor(i).inertia_kg_m2 = 0.05;
  }
  rig.start();
  rig.command_all(0.1);
  ASSERT_GT(rig.run_until_well(kUp_ns), 0);
  rig.run(30 * kMs);
  rig.emulator(0).set_fault(EmulatorFault::power_cycled);
  rig.run(500 * kMs);
  rig.board().clear_faults();
  rig.run(400 * kMs, [&](auto& samples, auto&) {
    for (std::size_t i = 1; i < 3; ++i) {
      EXPECT_EQ(samples[i].status, kDeviceOk) << rig.board().trouble(i).what;
      EXPECT_NEAR(rig.emulator(i).shaft().torque_Nm, 0.1, 1e-9);
    }
  });
  EXPECT_TRUE(rig.are_well());
  EXPECT_EQ(times_s(rig.log(), " 081#3081010000000000").size(), 2U);
}

}  // namespace
}  // namespace tactus::drivers
