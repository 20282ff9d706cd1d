#include "drivers/odrive_can/odrive_can.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <optional>

#include "host_tools/emulators/odrive_emulator.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {
namespace {

using host::ODriveEmulator;
using host::ODriveEmulatorConfig;
using host::ODriveFirmware;
using ODriveRig = CanRig<ODriveCan, ODriveEmulator>;

// The messages themselves, both codes against each other.
class ODriveMessages : public ::testing::TestWithParam<ODriveFirmware> {
 protected:
  static constexpr std::uint8_t kNode = 5;

  // Sends to the drive and returns its answer with that command, if any.
  std::optional<hal::CanFrame> exchange(const hal::CanFrame& frame) {
    EXPECT_TRUE(host_.send(frame));
    clock_.advance_by(kMs);
    emulator_.run(clock_.now_ns());
    std::array<hal::CanReceived, 64> received;
    const auto count = host_.receive(received, hal::kNoWait);
    for (std::size_t i = 0; count && i < *count; ++i) {
      if (received[i].frame.id == frame.id) {
        return received[i].frame;
      }
    }
    return std::nullopt;
  }
  std::optional<hal::CanFrame> ask(odrive::Command command) {
    return exchange(odrive::request(kNode, command, true));
  }
  // A drive in closed loop and torque mode.
  void arm() {
    exchange(odrive::clear_errors(kNode));
    exchange(odrive::set_torque_mode(kNode));
    exchange(odrive::set_input_torque(kNode, 0.0F));
    exchange(odrive::set_axis_state(kNode, odrive::AxisState::closed_loop));
  }
  bool is_0_6() const { return GetParam() == ODriveFirmware::v0_6; }

  hal::SimulatedClock clock_;
  hal::SimulatedCanNetwork network_{clock_};
  hal::SimulatedCanBus host_{network_};
  hal::SimulatedCanBus node_{network_};
  ODriveEmulator emulator_{node_,
                           1,
                           {.node_id = kNode,
                            .encoder = host::EmulatedEncoder::multi_turn,
                            .firmware = GetParam(),
                            .heartbeat_ms = 0,
                            .encoder_ms = 0,
                            .watchdog_s = 0.0}};
};

INSTANTIATE_TEST_SUITE_P(Firmware, ODriveMessages,
                         ::testing::Values(ODriveFirmware::v0_5_2, ODriveFirmware::v0_5_4,
                                           ODriveFirmware::v0_5_6, ODriveFirmware::v0_6));

TEST_P(ODriveMessages, OnlyFirmware06TellsItsVersion) {
  const auto answer = ask(odrive::Command::get_version);
  EXPECT_EQ(answer.has_value(), is_0_6());
  if (answer) {
    const auto version = odrive::read_version(*answer);
    ASSERT_TRUE(version);
    EXPECT_EQ(version->protocol, 2U);
    EXPECT_EQ(version->minor, 6U);
    EXPECT_EQ(version->revision, 9U);
  }
}

TEST_P(ODriveMessages, StateAndTorqueArriveAsSent) {
  arm();
  const auto heartbeat = odrive::read_heartbeat(*ask(odrive::Command::heartbeat));
  ASSERT_TRUE(heartbeat);
  EXPECT_EQ(heartbeat->state, 8U);
  EXPECT_EQ(heartbeat->error, 0U);
  exchange(odrive::set_input_torque(kNode, -0.375F));
  EXPECT_EQ(emulator_.shaft().torque_Nm, -0.375);
  exchange(odrive::set_axis_state(kNode, odrive::AxisState::idle));
  EXPECT_EQ(emulator_.axis_state(), 1U);
  EXPECT_EQ(emulator_.shaft().torque_Nm, 0.0);
}

TEST_P(ODriveMessages, LimitsArriveAsSent) {
  exchange(odrive::set_limits(kNode, 2.0 * std::numbers::pi * 30.0, 20.0));
  EXPECT_EQ(emulator_.speed_limit_turn_per_s(), 30.0);
}

TEST_P(ODriveMessages, EstimatesComeBackInRadians) {
  emulator_.shaft() = {.position_rad = 1.25, .velocity_rad_per_s = -3.5};
  for (const bool remote : {true, false}) {
    const auto answer = exchange(odrive::request(kNode, odrive::Command::get_estimates, remote));
    const bool understands = remote || is_0_6() || GetParam() == ODriveFirmware::v0_5_6;
    ASSERT_EQ(answer.has_value(), understands);
    if (answer) {
      const auto estimates = odrive::read_estimates(*answer);
      EXPECT_NEAR(estimates->position_rad, 1.25, 1e-6);
      EXPECT_NEAR(estimates->velocity_rad_per_s, -3.5, 1e-6);
    }
  }
}

TEST_P(ODriveMessages, ErrorsComeBackAsRaisedAndGoWhenCleared) {
  arm();
  if (is_0_6()) {
    emulator_.raise(0x0800'0000);
    const auto errors = odrive::read_errors(*ask(odrive::Command::get_error));
    EXPECT_EQ(errors->active, 0x0800'0000U);
    EXPECT_EQ(errors->disarm_reason, 0x0800'0000U);
  } else {
    emulator_.raise_motor_error(0x8'0000'0000);
    EXPECT_EQ(odrive::read_motor_error(*ask(odrive::Command::get_motor_error)), 0x8'0000'0000U);
    EXPECT_EQ(odrive::read_part_error(*ask(odrive::Command::get_encoder_error)), 0U);
    const auto controller = ask(odrive::Command::get_controller_error);
    EXPECT_EQ(controller.has_value(), GetParam() == ODriveFirmware::v0_5_6);
  }
  EXPECT_NE(odrive::read_heartbeat(*ask(odrive::Command::heartbeat))->error, 0U);
  exchange(odrive::clear_errors(kNode));
  EXPECT_EQ(odrive::read_heartbeat(*ask(odrive::Command::heartbeat))->error, 0U);
}

TEST_P(ODriveMessages, ReadingsComeBack) {
  arm();
  exchange(odrive::set_input_torque(kNode, 0.055F));
  EXPECT_NEAR(odrive::read_current(*ask(odrive::Command::get_iq))->measured_A, 1.0, 1e-6);
  EXPECT_EQ(odrive::read_bus_power(*ask(odrive::Command::get_bus))->bus_V, 24.0);
  if (is_0_6()) {
    EXPECT_EQ(odrive::read_temperature(*ask(odrive::Command::get_temperature))->motor_C, 36.25);
    EXPECT_NEAR(odrive::read_torques(*ask(odrive::Command::get_torques))->estimate_Nm, 0.055, 1e-7);
  }
}

class ODriveBringUp : public ::testing::TestWithParam<ODriveFirmware> {};

INSTANTIATE_TEST_SUITE_P(Firmware, ODriveBringUp,
                         ::testing::Values(ODriveFirmware::v0_5_2, ODriveFirmware::v0_5_4,
                                           ODriveFirmware::v0_5_6, ODriveFirmware::v0_6));

TEST_P(ODriveBringUp, EndsInClosedLoopWithTheGenerationKnown) {
  ODriveRig rig({}, std::vector<ODriveConfig>{{.node_id = 3}},
                std::vector<ODriveEmulatorConfig>{{.node_id = 3, .firmware = GetParam()}});
  rig.start();
  rig.command_all(0.1);
  EXPECT_GT(rig.run_until_well(1000 * kMs), 0) << rig.board().trouble(0).what;
  EXPECT_EQ(rig.driver(0).generation(), GetParam() == ODriveFirmware::v0_6
                                            ? odrive::Generation::v0_6
                                            : odrive::Generation::v0_5);
  rig.run(2 * kMs);
  EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, 0.1, 1e-8);
}

TEST_P(ODriveBringUp, TurnsNothingBeforeItIsWell) {
  ODriveRig rig({}, std::vector<ODriveConfig>{{}},
                std::vector<ODriveEmulatorConfig>{{.firmware = GetParam()}});
  rig.start();
  rig.command_all(0.1);
  while (!rig.are_well()) {
    ASSERT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
    ASSERT_LT(rig.clock().now_ns(), 3000 * kMs) << rig.board().trouble(0).what;
    rig.run(kMs);
  }
}

TEST_P(ODriveBringUp, TakesOverADriveThatAnotherProgramLeftRunning) {
  ODriveRig rig({}, std::vector<ODriveConfig>{{.unproven_watchdog = true}},
                std::vector<ODriveEmulatorConfig>{{.firmware = GetParam(), .watchdog_s = 0.0}});
  rig.start();
  rig.command_all(0.1);
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.run(10 * kMs);
  rig.start();
  rig.run(3 * kMs);
  EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
  EXPECT_FALSE(rig.are_well());
  EXPECT_GT(rig.run_until_well(1000 * kMs), 0) << rig.board().trouble(0).what;
}

TEST(ODriveCan, AsksForEstimatesWhereTheDriveSendsNone) {
  for (const bool remote : {true, false}) {
    ODriveRig rig({},
                  std::vector<ODriveConfig>{
                      {.estimates = ODriveEstimates::requested, .ask_by_remote_frame = remote}},
                  std::vector<ODriveEmulatorConfig>{{.encoder_ms = 0}});
    rig.start();
    rig.command_all(0.01);
    EXPECT_GT(rig.run_until_well(1000 * kMs), 0) << rig.board().trouble(0).what;
    rig.run(50 * kMs, [&](auto& samples, auto&) {
      EXPECT_LT(rig.clock().now_ns() - samples[0].time_ns, 300 * kUs);
    });
    EXPECT_TRUE(rig.are_well());
  }
}

TEST(ODriveCan, SetsTheDrivesLimitsBeforeClosedLoop) {
  ODriveRig rig({},
                std::vector<ODriveConfig>{{.drive_speed_limit_rad_per_s = 20.0 * std::numbers::pi,
                                           .drive_current_limit_A = 10.0}},
                std::vector<ODriveEmulatorConfig>{{.speed_limit_turn_per_s = 2.0}});
  rig.start();
  EXPECT_GT(rig.run_until_well(1000 * kMs), 0);
  EXPECT_EQ(rig.emulator(0).speed_limit_turn_per_s(), 10.0);
}

TEST(ODriveCan, NeverSendsATorqueBeyondItsLimit) {
  ODriveRig rig({}, std::vector<ODriveConfig>{{.max_torque_Nm = 0.1}},
                std::vector<ODriveEmulatorConfig>{{}});
  rig.rotor(0).inertia_kg_m2 = 1.0;
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  for (const double wanted : {1.0, -1.0, 1e30, std::numeric_limits<double>::infinity()}) {
    rig.command_all(wanted);
    rig.run(2 * kMs);
    EXPECT_LE(std::abs(rig.emulator(0).shaft().torque_Nm), 0.1);
    EXPECT_GT(std::abs(rig.emulator(0).shaft().torque_Nm), 0.0999);
  }
  rig.command_all(std::numeric_limits<double>::quiet_NaN());
  rig.run(2 * kMs);
  EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
}

TEST(ODriveCan, WithoutEnableTheTorqueIsZero) {
  ODriveRig rig({}, std::vector<ODriveConfig>{{}}, std::vector<ODriveEmulatorConfig>{{}});
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.command_all(0.1);
  rig.run(2 * kMs);
  EXPECT_GT(rig.emulator(0).shaft().torque_Nm, 0.0);
  rig.run(2 * kMs, [](auto&, auto& commands) { commands[0].enable = false; });
  EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
}

TEST(ODriveCan, ShutdownTakesThePowerAway) {
  ODriveRig rig({}, std::vector<ODriveConfig>{{}}, std::vector<ODriveEmulatorConfig>{{}});
  rig.start();
  rig.command_all(0.1);
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.board().stop();
  rig.idle(kMs);
  EXPECT_EQ(rig.emulator(0).axis_state(), 1U);
  rig.run(5 * kMs);
  EXPECT_FALSE(rig.are_well());
  rig.start();
  EXPECT_GT(rig.run_until_well(1000 * kMs), 0) << rig.board().trouble(0).what;
}

TEST(ODriveCan, ReadsSupplyAndTemperatureSlowly) {
  ODriveRig rig({}, std::vector<ODriveConfig>{{.poll_period_s = 0.02}},
                std::vector<ODriveEmulatorConfig>{{}});
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.run(200 * kMs);
  EXPECT_EQ(rig.driver(0).readings().bus.bus_V, 24.0);
  EXPECT_EQ(rig.driver(0).readings().temperature.inverter_C, 41.5);
  EXPECT_EQ(rig.driver(0).readings().malformed, 0U);
}

TEST(ODriveCan, IgnoresOtherNodesAndOtherKindsOfFrames) {
  ODriveCan drive({.node_id = 1});
  drive.start(kMs);
  for (const std::string_view text : {"041#0000000001000000", "021#R", "00000021#0000000001000000",
                                      "021##00000000001000000", "021#00000000"}) {
    drive.take({.time_ns = 2 * kMs, .frame = frame_of(text)});
  }
  CanOutbox outbox;
  drive.command(3 * kMs, {}, outbox);
  outbox.clear();
  drive.command(4 * kMs, {}, outbox);
  EXPECT_TRUE(outbox.frames().empty());  // still listening for a heartbeat
  drive.take({.time_ns = 5 * kMs, .frame = frame_of("021#0000000001000000")});
  drive.command(6 * kMs, {}, outbox);
  EXPECT_FALSE(outbox.frames().empty());
}

TEST(ODriveCan, FilterPassesItsNodeOnly) {
  const ODriveCan drive({.node_id = 9});
  std::array<hal::CanFilter, kMaxFiltersPerDrive> filters;
  ASSERT_EQ(drive.filters(filters), 1U);
  for (std::uint32_t id = 0; id <= hal::kMaxStandardId; ++id) {
    EXPECT_EQ(hal::passes(filters[0], {.id = id}), id >> 5U == 9);
  }
  EXPECT_FALSE(hal::passes(filters[0], {.id = 9U << 5U, .extended = true}));
}

}  // namespace
}  // namespace tactus::drivers
