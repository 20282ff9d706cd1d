// The driver against an emulated VESC: bring-up, current, position, faults.
#include "drivers/vesc_can/vesc_can.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "host_tools/emulators/vesc_emulator.h"
#include "tests/unit/drivers/can_rig.h"
#include "tests/unit/hal/random.h"

namespace tactus::drivers {
namespace {

using host::EmulatorFault;
using VescRig = CanRig<VescCan, host::VescEmulator>;

// Status at 1 kHz, so that a VESC that falls silent is found as soon as any drive.
constexpr VescConfig kFastVesc{.vesc_id = 4,
                               .torque_constant_Nm_per_A = 0.03,
                               .max_torque_Nm = 0.3,
                               .status_period_s = 0.001,
                               .lost_after_s = 0.003};
constexpr host::VescEmulatorConfig kFastEmulator{.vesc_id = 4, .status_period_ns = kMs};

VescRig one_vesc(const VescConfig& driver = kFastVesc,
                 const host::VescEmulatorConfig& drive = kFastEmulator) {
  return VescRig({}, std::vector{driver}, std::vector{drive});
}

class VescFaultPort : public ::testing::Test {
 protected:
  VescFaultPort() {
    rig_.rotor(0) = {.inertia_kg_m2 = 0.05, .damping_Nm_s = 0.01};
    rig_.start();
    rig_.command_all(0.15);
    EXPECT_GT(rig_.run_until_well(1000 * kMs), 0) << trouble().what;
    rig_.run(20 * kMs);
    EXPECT_NEAR(torque_Nm(), 0.15, 1e-6);
  }
  void expect_stopped_within(hal::TimeNs limit_ns, std::uint32_t bits) {
    const hal::TimeNs passed_ns =
        rig_.run_until(300 * kMs, [&] { return torque_Nm() == 0.0 && (status() & bits) != 0; });
    EXPECT_GT(passed_ns, 0) << status();
    EXPECT_LE(passed_ns, limit_ns);
    expect_latched(bits);
  }
  void expect_latched(std::uint32_t bits) {
    EXPECT_NE(status() & bits, 0U) << status() << ' ' << trouble().what;
    EXPECT_EQ(torque_Nm(), 0.0);
    EXPECT_FALSE(trouble().what.empty());
    EXPECT_NE(trouble().remedy.find("reset"), std::string_view::npos) << trouble().remedy;
  }
  void expect_recovery() {
    rig_.emulator(0).set_fault(EmulatorFault::none);
    rig_.run(700 * kMs);
    EXPECT_NE(status(), kDeviceOk) << "not latched";
    EXPECT_EQ(torque_Nm(), 0.0);
    rig_.board().clear_faults();
    EXPECT_GT(rig_.run_until_well(1000 * kMs), 0) << trouble().what;
    rig_.run(20 * kMs);
    EXPECT_NEAR(torque_Nm(), 0.15, 1e-6);
  }

  std::uint32_t status() const { return rig_.sample(0).status; }
  double torque_Nm() { return rig_.emulator(0).shaft().torque_Nm; }
  Trouble trouble() { return rig_.board().trouble(0); }

  VescRig rig_ = one_vesc();
};

TEST(VescCan, AmplifierIsWellAndItsSamplesHaveNoTime) {
  VescRig rig = one_vesc();
  rig.start();
  EXPECT_GT(rig.run_until_well(1000 * kMs), 0) << rig.board().trouble(0).what;
  EXPECT_EQ(rig.sample(0).time_ns, 0);
  const hal::TimeNs before_ns = rig.clock().now_ns();
  rig.run(kMs, [&](auto&, auto&) { EXPECT_LT(rig.clock().now_ns() - before_ns, 1100 * kUs); });
}

TEST(VescCan, TorqueIsCurrentTimesTheConstantDownToZero) {
  VescRig rig = one_vesc();
  rig.rotor(0).inertia_kg_m2 = 0.05;
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  // 0.5 mN m are 17 mA, far below the VESC's smallest current: the off-delay keeps it alive.
  for (const double torque_Nm : {0.2, -0.03, 0.0005, -0.0005}) {
    rig.command_all(torque_Nm);
    rig.run(10 * kMs);
    EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, torque_Nm, 0.5e-3 * 0.03 + 1e-9);
  }
  rig.run(5 * kMs, [](auto&, auto& commands) { commands[0].enable = false; });
  EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
}

TEST(VescCan, TorqueBeyondTheLimitIsClampedAndNoNumberIsNone) {
  VescRig rig = one_vesc();
  rig.rotor(0).inertia_kg_m2 = 0.05;
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  for (const double wild_Nm : {1e12, -1e12, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
    rig.command_all(wild_Nm);
    rig.run(5 * kMs);
    const double expected_Nm = std::isfinite(wild_Nm) ? std::copysign(0.3, wild_Nm) : 0.0;
    EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, expected_Nm, 1e-9);
  }
}

TEST(VescCan, VelocityTorqueAndReadingsComeFromTheStatus) {
  VescRig rig = one_vesc();
  rig.rotor(0) = {.inertia_kg_m2 = 1e6, .damping_Nm_s = 0.0};
  rig.emulator(0).shaft().velocity_rad_per_s = -33.0;
  rig.emulator(0).set_temperatures(41.5, 36.0);
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.command_all(0.12);
  rig.run(250 * kMs);
  EXPECT_NEAR(rig.sample(0).velocity_rad_per_s, -33.0, 0.02);
  EXPECT_NEAR(rig.sample(0).torque_Nm, 0.12, 0.0016);
  EXPECT_NEAR(rig.driver(0).readings().status_4.fet_C, 41.5, 1e-9);
  EXPECT_NEAR(rig.driver(0).readings().status_4.motor_C, 36.0, 1e-9);
  EXPECT_NEAR(rig.driver(0).readings().input_V, 48.0, 1e-9);
}

TEST(VescCan, TachometerIsThePositionIfAskedFor) {
  VescConfig config = kFastVesc;
  config.offers_position = true;
  VescRig rig = one_vesc(config);
  rig.emulator(0).shaft().velocity_rad_per_s = 20.0;
  rig.rotor(0).damping_Nm_s = 0.0;
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  const double count_rad = 2.0 * std::numbers::pi / 42.0;
  rig.run(500 * kMs, [&](auto& samples, auto&) {
    ASSERT_EQ(samples[0].status & ~std::uint32_t{kDeviceStale}, kDeviceOk);
    EXPECT_NE(samples[0].time_ns, 0);
    EXPECT_NEAR(samples[0].position_rad, rig.emulator(0).shaft().position_rad,
                count_rad / 2.0 + 20.0 * 0.0025);
  });
}

TEST(VescCan, WhatIsMissingIsTold) {
  struct Case {
    std::function<void(VescConfig&, host::VescEmulatorConfig&)> make;
    std::uint32_t status = kDeviceDriveFault;
    std::string_view words;
  };
  const std::vector<Case> cases = {
      {[](auto&, auto& drive) { drive.status_period_ns = 0; }, kDeviceDriveFault,
       "no status message 1"},
      {[](auto& driver, auto& drive) {
         driver.offers_position = true;
         drive.sends_status_5 = false;
       },
       kDeviceDriveFault, "status message 5"},
      {[](auto&, auto& drive) { drive.vesc_id = 5; }, kDeviceLost, "does not answer"},
  };
  for (const Case& one : cases) {
    VescConfig driver = kFastVesc;
    host::VescEmulatorConfig drive = kFastEmulator;
    driver.bring_up_s = 0.2;
    one.make(driver, drive);
    VescRig rig = one_vesc(driver, drive);
    rig.start();
    rig.run(250 * kMs);
    EXPECT_EQ(rig.sample(0).status, one.status);
    EXPECT_NE(rig.board().trouble(0).what.find(one.words), std::string_view::npos)
        << rig.board().trouble(0).what;
  }
}

TEST(VescCan, OrderlyEndLetsTheMotorGo) {
  VescRig rig = one_vesc();
  rig.rotor(0).inertia_kg_m2 = 0.05;
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.command_all(0.1);
  rig.run(10 * kMs);
  rig.board().stop();
  rig.clock().advance_by(kMs);
  EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
}

TEST(VescCan, FieldOutOfItsRangeIsNamed) {
  EXPECT_TRUE(check(kFastVesc));
  const std::vector<std::pair<std::string, std::function<void(VescConfig&)>>> mistakes = {
      {"vesc_id", [](auto& c) { c.vesc_id = 255; }},
      {"host_id", [](auto& c) { c.host_id = 255; }},
      {"host_id", [](auto& c) { c.host_id = c.vesc_id; }},
      {"torque_constant_Nm_per_A", [](auto& c) { c.torque_constant_Nm_per_A = 0.0; }},
      {"max_torque_Nm",
       [](auto& c) { c.max_torque_Nm = std::numeric_limits<double>::quiet_NaN(); }},
      {"pole_pairs", [](auto& c) { c.pole_pairs = 0; }},
      {"off_delay_s", [](auto& c) { c.off_delay_s = 0.0; }},
      {"max_speed_rad_per_s", [](auto& c) { c.max_speed_rad_per_s = 0.0; }},
      {"jump_margin_rad", [](auto& c) { c.jump_margin_rad = 4.0; }},
      {"status_period_s", [](auto& c) { c.status_period_s = 1.0; }},
      {"lost_after_s", [](auto& c) { c.lost_after_s = c.status_period_s; }},
      {"poll_period_s", [](auto& c) { c.poll_period_s = 0.0; }},
      {"bring_up_s", [](auto& c) { c.bring_up_s = 0.0; }},
  };
  for (const auto& [field, make] : mistakes) {
    VescConfig config = kFastVesc;
    make(config);
    const Checked refused = check(config);
    ASSERT_FALSE(refused) << field;
    EXPECT_EQ(refused.error().field, field);
    EXPECT_FALSE(refused.error().rule.empty());
  }
}

TEST_F(VescFaultPort, SilentVescIsStoppedInFiveMilliseconds) {
  rig_.emulator(0).set_fault(EmulatorFault::silent);
  expect_stopped_within(5 * kMs, kDeviceLost);
  expect_recovery();
}

TEST_F(VescFaultPort, DelayedVescIsStoppedInFiveMilliseconds) {
  rig_.emulator(0).set_fault(EmulatorFault::delayed);
  expect_stopped_within(5 * kMs, kDeviceLost);
  expect_recovery();
}

TEST_F(VescFaultPort, UnpluggedVescIsLostInFiveMilliseconds) {
  rig_.emulator(0).set_fault(EmulatorFault::unplugged);
  expect_stopped_within(5 * kMs, kDeviceLost);
  expect_recovery();
}

TEST_F(VescFaultPort, CorruptedVescIsStoppedOnceItShows) {
  rig_.emulator(0).set_fault(EmulatorFault::corrupted);
  expect_stopped_within(
      60 * kMs, kDeviceEncoderFault | kDeviceDriveFault | kDeviceEmergencyStop | kDeviceLost);
  expect_recovery();
}

// The VESC stops at once by itself; the host knows with the next answer but one.
TEST_F(VescFaultPort, ErringVescIsToldWithItsCode) {
  rig_.emulator(0).set_fault(EmulatorFault::erroring);
  rig_.run(kMs);
  EXPECT_EQ(torque_Nm(), 0.0);
  expect_stopped_within(25 * kMs, kDeviceDriveFault);
  EXPECT_EQ(trouble().code, 4U);
  EXPECT_NE(trouble().what.find("absolute over-current"), std::string_view::npos);
  expect_recovery();
}

// It would obey again after half a second, and must not.
TEST_F(VescFaultPort, FaultThatTheVescForgetsStaysLatched) {
  rig_.emulator(0).set_fault(EmulatorFault::erroring);
  rig_.run(30 * kMs);
  rig_.emulator(0).set_fault(EmulatorFault::none);
  rig_.run(2000 * kMs, [&](auto&, auto&) { ASSERT_EQ(torque_Nm(), 0.0); });
  expect_latched(kDeviceDriveFault);
  expect_recovery();
}

TEST_F(VescFaultPort, KillSwitchIsAnEmergencyStop) {
  rig_.emulator(0).set_kill_switch(true);
  expect_stopped_within(25 * kMs, kDeviceEmergencyStop);
  rig_.emulator(0).set_kill_switch(false);
  expect_recovery();
}

TEST_F(VescFaultPort, HostThatFallsSilentLeavesNoTorqueAfterTheVescsTimeout) {
  rig_.idle(1100 * kMs);
  EXPECT_EQ(torque_Nm(), 0.0);
}

// The status goes on, the questions are not answered any more.
TEST(VescCan, NoTorqueGoesOutInTheTickThatGivesTheVescUp) {
  VescCan drive({.vesc_id = 1,
                 .host_id = 2,
                 .torque_constant_Nm_per_A = 0.05,
                 .max_torque_Nm = 0.2,
                 .unproven_watchdog = true});
  hal::TimeNs now_ns = 1'000'000'000;
  drive.start(now_ns);
  const auto tick = [&](bool answers) {
    now_ns += kMs;
    const hal::CanFrame status{.id = 0x901, .extended = true, .length = 8};
    drive.take({.time_ns = now_ns, .frame = status});
    if (answers) {
      hal::CanFrame answer{.id = 0x802, .extended = true, .length = 8};
      for (std::size_t i = 0; const unsigned byte : {0x01U, 0x01U, 0x32U, 0x00U, 0x00U, 0x80U}) {
        answer.data[i++] = static_cast<std::byte>(byte);
      }
      drive.take({.time_ns = now_ns, .frame = answer});
    }
    CanOutbox outbox;
    drive.command(now_ns, {.torque_Nm = 0.1, .enable = true}, outbox);
    const hal::CanFrame& current = outbox.frames()[0];
    return current.id == 0x101 && (current.data[2] | current.data[3]) != std::byte{0};
  };
  for (int i = 0; i < 5; ++i) {
    tick(true);
  }
  ASSERT_EQ(drive.sample().status, kDeviceOk) << drive.trouble().what;
  for (int i = 0; i < 10'000 && drive.sample().status == kDeviceOk; ++i) {
    const bool has_torque = tick(false);
    EXPECT_EQ(has_torque, drive.sample().status == kDeviceOk) << i;
  }
  EXPECT_EQ(drive.sample().status, kDeviceLost);
}

TEST(VescCan, PositionThatJumpsIsNeverReported) {
  VescConfig config = kFastVesc;
  config.offers_position = true;
  VescRig rig = one_vesc(config);
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  const double before_rad = rig.sample(0).position_rad;
  rig.emulator(0).slip(200);
  rig.run(5 * kMs);
  EXPECT_NE(rig.sample(0).status & kDeviceEncoderFault, 0U);
  EXPECT_NEAR(rig.sample(0).position_rad, before_rad, 0.2);
}

// Whatever comes off the bus: the current on the wire stays within the limit, 10 A.
TEST(VescProperty, NoByteSequenceMakesAJumpOrTorqueBeyondTheLimit) {
  hal::Random random(4);
  VescConfig config = kFastVesc;
  config.offers_position = true;
  int valid_samples = 0;
  for (int session = 0; session < 40; ++session) {
    VescRig rig = one_vesc(config);
    hal::SimulatedCanBus stranger(rig.network());
    hal::SimulatedCanBus listener(rig.network());
    rig.start();
    if (!random.one_in(4)) {
      ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
    }
    std::array<hal::CanReceived, 64> heard;
    while (listener.receive(heard, hal::kNoWait)) {
    }
    AxisSample last;
    rig.run(200 * kMs, [&](auto& samples, auto& commands) {
      const AxisSample& sample = samples[0];
      ASSERT_TRUE(std::isfinite(sample.position_rad) && std::isfinite(sample.velocity_rad_per_s));
      const bool is_valid = (sample.status & ~std::uint32_t{kDeviceStale}) == kDeviceOk;
      if (is_valid) {
        ++valid_samples;
        ASSERT_LE(std::abs(sample.velocity_rad_per_s), config.max_speed_rad_per_s);
        const double passed_s = 1e-9 * static_cast<double>(sample.time_ns - last.time_ns);
        const double margin_rad = 2.0 * (0.05 + 2.0 * 2.0 * std::numbers::pi / 42.0);
        ASSERT_TRUE(last.time_ns == 0 || std::abs(sample.position_rad - last.position_rad) <=
                                             1000.0 * passed_s + margin_rad + 1e-9)
            << random.seed() << ' ' << session;
      }
      last = is_valid ? sample : AxisSample{};
      commands[0] = {.torque_Nm = std::ldexp(static_cast<double>(random.bits()) - 2e9,
                                             static_cast<int>(random.below(80)) - 60),
                     .enable = !random.one_in(10)};
      if (random.one_in(3)) {
        constexpr std::array<std::uint32_t, 4> kPackets = {0x904, 0x1004, 0x1B04, 0x8FD};
        hal::CanFrame frame{.id = kPackets[random.below(4)], .extended = true, .length = 8};
        for (std::byte& byte : frame.data) {
          byte = random.one_in(3) ? static_cast<std::byte>(random.bits() & 0xFFU) : std::byte{0};
        }
        (void)stranger.send(frame);
      }
      if (random.one_in(30)) {
        rig.board().clear_faults();
      }
    });
    while (const auto count = listener.receive(heard, hal::kNoWait)) {
      for (std::size_t i = 0; i < *count; ++i) {
        const hal::CanFrame& frame = heard[i].frame;
        std::uint32_t bits = 0;
        for (std::size_t byte = 0; byte < 4; ++byte) {
          bits = bits << 8U | std::to_integer<std::uint32_t>(frame.data[byte]);
        }
        ASSERT_TRUE(frame.id != 0x104 || std::abs(static_cast<std::int32_t>(bits)) <= 10'000)
            << random.seed() << ' ' << session;
      }
    }
  }
  EXPECT_GT(valid_samples, 200);
}

}  // namespace
}  // namespace tactus::drivers
