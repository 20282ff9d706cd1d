#include "drivers/moteus_canfd/moteus_canfd.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "host_tools/emulators/moteus_emulator.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {
namespace {

using host::MoteusEmulator;
using host::MoteusEmulatorConfig;
using MoteusRig = CanRig<MoteusCanFd, MoteusEmulator>;

CanRigConfig fd_bus() {
  return {.network = {.fd = true, .bit_rate = 1'000'000, .data_bit_rate = 5'000'000}};
}

// The messages themselves, both codes against each other and against the manual's frames.
class MoteusMessages : public ::testing::Test {
 protected:
  std::optional<hal::CanFrame> exchange(const hal::CanFrame& frame, hal::TimeNs pause_ns = kMs) {
    EXPECT_TRUE(host_.send(frame));
    clock_.advance_by(pause_ns);
    emulator_.run(clock_.now_ns());
    std::array<hal::CanReceived, 8> received;
    const auto count = host_.receive(received, hal::kNoWait);
    return count ? std::optional(received[*count - 1].frame) : std::nullopt;
  }
  moteus::Reply ask(const hal::CanFrame& frame) {
    const auto answer = exchange(frame);
    EXPECT_TRUE(answer);
    return answer ? moteus::read_reply(answer->bytes()) : moteus::Reply{};
  }
  // In position mode with torque zero.
  void start() {
    exchange(moteus::torque(kAddress, 0.0F, 1.0F, false));
    exchange(moteus::torque(kAddress, 0.0F, 1.0F, false), 50 * kMs);
    ASSERT_EQ(emulator_.mode(), 10);
  }

  static constexpr moteus::Address kAddress{.servo = 1, .host = 0};
  hal::SimulatedClock clock_;
  hal::SimulatedCanNetwork network_{clock_, {.fd = true}};
  hal::SimulatedCanBus host_{network_};
  hal::SimulatedCanBus node_{network_};
  MoteusEmulator emulator_{node_, 1, {.max_torque_Nm = 5.0}};
};

TEST_F(MoteusMessages, QueryComesBackAsTheShaftIs) {
  emulator_.shaft() = {.position_rad = 3.5, .velocity_rad_per_s = -2.25};
  const moteus::Reply reply = ask(moteus::query(kAddress));
  EXPECT_EQ(reply.mode, 0);
  EXPECT_NEAR(reply.position_rad.value(), 3.5, 1e-6);
  EXPECT_NEAR(reply.velocity_rad_per_s.value(), -2.25, 1e-6);
  EXPECT_EQ(reply.torque_Nm, 0.0);
  EXPECT_EQ(reply.voltage_V, 24.0);
  EXPECT_EQ(reply.temperature_C, 31.0);
  EXPECT_EQ(reply.fault, 0);
}

TEST_F(MoteusMessages, TorqueArrivesAsSentWithoutAnyGain) {
  start();
  emulator_.shaft() = {.position_rad = 1.0, .velocity_rad_per_s = 2.0};
  exchange(moteus::torque(kAddress, -0.375F, 0.05F, false));
  EXPECT_EQ(emulator_.shaft().torque_Nm, -0.375);
}

TEST_F(MoteusMessages, WatchdogArrivesAsSent) {
  start();
  exchange(moteus::torque(kAddress, 0.1F, 0.05F, false));
  clock_.advance_by(48 * kMs);
  emulator_.run(clock_.now_ns());
  EXPECT_EQ(emulator_.mode(), 10);
  clock_.advance_by(3 * kMs);
  emulator_.run(clock_.now_ns());
  EXPECT_EQ(emulator_.mode(), 11);
}

TEST_F(MoteusMessages, StopEndsFaultAndTimeoutAndNothingElseDoes) {
  start();
  emulator_.raise_fault(34);
  EXPECT_EQ(ask(moteus::torque(kAddress, 0.1F, 0.05F, true)).fault, 34);
  EXPECT_EQ(ask(moteus::query(kAddress)).mode, 1);
  EXPECT_EQ(ask(moteus::stop(kAddress, true)).mode, 1);  // from before it was stopped
  const moteus::Reply reply = ask(moteus::stop(kAddress, true));
  EXPECT_EQ(reply.mode, 0);
  EXPECT_EQ(reply.fault, 0);
}

TEST_F(MoteusMessages, RepliesComeInTheFrameKindAndRateOfTheQuery) {
  moteus::Address slow = kAddress;
  slow.bit_rate_switch = false;
  EXPECT_TRUE(exchange(moteus::query(kAddress))->bit_rate_switch);
  EXPECT_FALSE(exchange(moteus::query(slow))->bit_rate_switch);
  EXPECT_EQ(exchange(moteus::query(kAddress))->id, moteus::reply_id(kAddress));
  EXPECT_EQ(exchange(moteus::stop(kAddress, false)), std::nullopt);
}

TEST_F(MoteusMessages, PrefixAndServoMustFit) {
  EXPECT_FALSE(exchange(moteus::query({.servo = 2})));
  EXPECT_FALSE(exchange(moteus::query({.servo = 1, .prefix = 1})));
  EXPECT_TRUE(exchange(moteus::query({.servo = 1, .host = 5})));
}

// The manual's position command in int16, and a reply of the manual's layout. Beside its torque of
// -1.76 N m the servo's own gains pull towards 0.0096 rev at 0.072 rev/s.
TEST_F(MoteusMessages, EmulatorObeysThePublishedFrame) {
  start();
  const auto answer = exchange(frame_of("00008001##1 01000a 0720 6000 2001 50ff 140400 130d"));
  ASSERT_TRUE(answer);
  EXPECT_EQ(text_of(*answer), "100##12404000A00000000000000230D301F00");
  EXPECT_NEAR(emulator_.shaft().torque_Nm, -1.76 + 4.0 * 0.0096 + 0.05 * 0.072, 1e-9);
}

TEST_F(MoteusMessages, EmulatorTakesTheCompactTorqueFrame) {
  start();
  emulator_.shaft().position_rad = 1.0;
  exchange(
      frame_of("00008001##1 01000a 0720 0080 0000 1900 0223 00 00 0527 1400 012b 00 140400"
               " 130d 50 50 50 50 50"));
  EXPECT_NEAR(emulator_.shaft().torque_Nm, 0.25, 1e-12);
  clock_.advance_by(21 * kMs);
  emulator_.run(clock_.now_ns());
  EXPECT_EQ(emulator_.mode(), 11);
}

// A frame of the vendor's tests that writes every register of the command in int16.
TEST_F(MoteusMessages, EmulatorTakesTheMaximalFrame) {
  start();
  EXPECT_FALSE(ask(frame_of("00008001##1 01000a040b20c409d0076400ff1fff0f2003204ec800204ed0072800"
                            "1100 50 50"))
                   .refused_register);
  // 1 N m, a quarter of 4 N m/rev over 0.25 rev, an eighth of 0.05 N m s/rev over 0.5 rev/s
  EXPECT_NEAR(emulator_.shaft().torque_Nm, 1.0 + 0.25 + 0.003125, 1e-3);
}

TEST_F(MoteusMessages, UnknownRegisterIsRefused) {
  EXPECT_EQ(ask(frame_of("00008001##1 0140 00 1100 50 50 50")).refused_register, 0x40U);
  EXPECT_EQ(ask(frame_of("00008001##1 118220")).refused_register, 0x1002U);
}

class MoteusBringUp : public ::testing::TestWithParam<MoteusQuery> {};

INSTANTIATE_TEST_SUITE_P(Query, MoteusBringUp,
                         ::testing::Values(MoteusQuery::with_command, MoteusQuery::before_command));

TEST_P(MoteusBringUp, EndsUnderTorqueAndTurnsNothingBefore) {
  MoteusRig rig(fd_bus(), std::vector<MoteusConfig>{{.servo_id = 9, .query = GetParam()}},
                std::vector<MoteusEmulatorConfig>{{.servo_id = 9}});
  rig.start();
  rig.command_all(0.1);
  while (!rig.are_well()) {
    ASSERT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
    ASSERT_LT(rig.clock().now_ns(), 3000 * kMs) << rig.board().trouble(0).what;
    rig.run(kMs);
  }
  rig.run(2 * kMs);
  EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, 0.1, 1e-8);
  EXPECT_NEAR(rig.sample(0).torque_Nm, 0.1, 1e-8);
  EXPECT_EQ(rig.driver(0).readings().voltage_V, 24.0);
  EXPECT_EQ(rig.driver(0).readings().malformed, 0U);
}

TEST_P(MoteusBringUp, TakesOverAServoThatIsInFaultOrRuns) {
  MoteusRig rig(fd_bus(), std::vector<MoteusConfig>{{.query = GetParam()}},
                std::vector<MoteusEmulatorConfig>{{}});
  rig.emulator(0).raise_fault(36);
  rig.start();
  rig.command_all(0.1);
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0) << rig.board().trouble(0).what;
  rig.start();
  rig.run(3 * kMs);
  EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0) << rig.board().trouble(0).what;
}

TEST(MoteusCanFd, SampleBeforeTheCommandIsFresher) {
  std::array<hal::TimeNs, 2> ages_ns{};
  for (const bool before : {false, true}) {
    MoteusRig rig(fd_bus(),
                  std::vector<MoteusConfig>{
                      {.query = before ? MoteusQuery::before_command : MoteusQuery::with_command}},
                  std::vector<MoteusEmulatorConfig>{{}});
    rig.start();
    ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
    rig.run(10 * kMs, [&](auto& samples, auto&) {
      ages_ns[before ? 1 : 0] = rig.clock().now_ns() - samples[0].time_ns;
    });
  }
  EXPECT_LT(ages_ns[1], 300 * kUs);
  EXPECT_GT(ages_ns[0], 500 * kUs);
  EXPECT_LT(ages_ns[0], 1000 * kUs);
}

TEST(MoteusCanFd, NeverSendsATorqueBeyondItsLimit) {
  MoteusRig rig(fd_bus(), std::vector<MoteusConfig>{{.max_torque_Nm = 0.1}},
                std::vector<MoteusEmulatorConfig>{{}});
  rig.rotor(0).inertia_kg_m2 = 1.0;
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  for (const double wanted : {1.0, -1.0, 1e30, -std::numeric_limits<double>::infinity()}) {
    rig.command_all(wanted);
    rig.run(2 * kMs);
    EXPECT_LE(std::abs(rig.emulator(0).shaft().torque_Nm), 0.1);
    EXPECT_GT(std::abs(rig.emulator(0).shaft().torque_Nm), 0.0999);
  }
  rig.command_all(std::numeric_limits<double>::quiet_NaN());
  rig.run(2 * kMs);
  EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
}

TEST(MoteusCanFd, WithoutEnableTheTorqueIsZeroAndTheServoStaysReady) {
  MoteusRig rig(fd_bus(), std::vector<MoteusConfig>{{}}, std::vector<MoteusEmulatorConfig>{{}});
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.command_all(0.1);
  rig.run(2 * kMs);
  rig.run(2 * kMs, [](auto&, auto& commands) { commands[0].enable = false; });
  EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
  EXPECT_EQ(rig.emulator(0).mode(), 10);
}

TEST(MoteusCanFd, ShutdownStopsTheServo) {
  MoteusRig rig(fd_bus(), std::vector<MoteusConfig>{{}}, std::vector<MoteusEmulatorConfig>{{}});
  rig.start();
  rig.command_all(0.1);
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.board().stop();
  rig.idle(kMs);
  EXPECT_EQ(rig.emulator(0).mode(), 0);
  rig.run(5 * kMs);
  EXPECT_FALSE(rig.are_well());
}

TEST(MoteusCanFd, FilterPassesItsRepliesOnly) {
  const MoteusCanFd drive({.servo_id = 2, .host_id = 1});
  std::array<hal::CanFilter, kMaxFiltersPerDrive> filters;
  const std::size_t count = drive.filters(filters);
  const auto passes = [&](const hal::CanFrame& frame) {
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
      any = any || hal::passes(filters[i], frame);
    }
    return any;
  };
  EXPECT_TRUE(passes({.id = 0x201}));
  EXPECT_TRUE(passes({.id = 0x201, .extended = true}));
  EXPECT_FALSE(passes({.id = 0x301}));
  EXPECT_FALSE(passes({.id = 0x8201, .extended = true}));
  EXPECT_FALSE(passes({.id = 0x10201, .extended = true}));
}

}  // namespace
}  // namespace tactus::drivers
