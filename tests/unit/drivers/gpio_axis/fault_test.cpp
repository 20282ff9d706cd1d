// Every way to fail ends in zero torque within a tick of its being seen, in a latched status bit,
// and in words that say what to do.
#include <cmath>

#include "tests/unit/drivers/gpio_axis/axis_bench.h"

namespace tactus::drivers {
namespace {

class GpioAxisFault : public ::testing::Test {
 protected:
  GpioAxisFault() {
    bench_.ticks(5, kPush, motion_);
    EXPECT_GT(bench_.torque(), 0.0);
  }
  void expect_latched(std::uint32_t status, GpioAxisTrouble trouble) {
    EXPECT_EQ(bench_.sample.status & status, status);
    EXPECT_EQ(bench_.code(), code_of(trouble));
    EXPECT_FALSE(bench_.axis.trouble(0).what.empty());
    EXPECT_FALSE(bench_.axis.trouble(0).remedy.empty());
    EXPECT_EQ(bench_.torque(), 0.0);
    bench_.ticks(20, kPush, motion_);
    EXPECT_EQ(bench_.sample.status & status, status) << "latched";
    EXPECT_EQ(bench_.torque(), 0.0);
  }
  void expect_well_after_reset() {
    bench_.axis.clear_faults();
    bench_.ticks(3, kPush, motion_);
    EXPECT_EQ(bench_.sample.status, kDeviceOk) << bench_.axis.trouble(0).what;
    EXPECT_FALSE(bench_.axis.trouble(0));
    EXPECT_GT(bench_.torque(), 0.0);
  }

  AxisBench bench_;
  std::function<double(double)> motion_ = [](double time_s) {
    return 0.2 * std::sin(20.0 * time_s) - 0.2 * std::sin(20.0 * 1.01);
  };
};

TEST_F(GpioAxisFault, EmergencyStopActsOnItsFirstEdgeHoweverShort) {
  bench_.emulator.open_emergency_stop(true);
  bench_.emulator.open_emergency_stop(false);
  bench_.tick(kPush, motion_);
  expect_latched(kDeviceEmergencyStop, GpioAxisTrouble::emergency_stop);
}

TEST_F(GpioAxisFault, EmergencyStopIsResetOnlyAfterTheChainStoodClosed) {
  bench_.emulator.open_emergency_stop(true);
  bench_.ticks(5, kPush, motion_);
  bench_.axis.clear_faults();
  EXPECT_EQ(bench_.code(), code_of(GpioAxisTrouble::emergency_stop)) << "still open";
  bench_.emulator.open_emergency_stop(false);
  bench_.ticks(30, kPush, motion_);
  bench_.axis.clear_faults();
  bench_.ticks(2, kPush, motion_);
  EXPECT_EQ(bench_.torque(), 0.0) << "closed for 30 ms of 50";
  bench_.ticks(30, kPush, motion_);
  EXPECT_EQ(bench_.sample.status, kDeviceEmergencyStop) << "nothing resets by itself";
  expect_well_after_reset();
}

TEST_F(GpioAxisFault, BridgeFaultIsLatched) {
  bench_.emulator.set_fault(host::EmulatorFault::erroring);
  bench_.tick(kPush, motion_);
  expect_latched(kDeviceDriveFault, GpioAxisTrouble::bridge_fault);
  bench_.emulator.set_fault(host::EmulatorFault::none);
  bench_.ticks(3, kPush, motion_);
  EXPECT_EQ(bench_.sample.status, kDeviceDriveFault) << "the device cleared it, the driver did not";
  expect_well_after_reset();
}

TEST_F(GpioAxisFault, BothLimitSwitchesAreABrokenWire) {
  bench_.emulator.open_limit_low(true);
  bench_.emulator.open_limit_high(true);
  bench_.ticks(7, kPush, motion_);
  expect_latched(kDeviceDriveFault, GpioAxisTrouble::limits_contradict);
}

TEST_F(GpioAxisFault, LostEdgesAreAnEncoderFaultAndNeverAPosition) {
  bench_.lines.lose_next_edges(3);
  bench_.ticks(8, kPush, motion_);
  expect_latched(kDeviceEncoderFault | kDeviceReferenceLost, GpioAxisTrouble::edges_lost);
  EXPECT_EQ(bench_.axis.edges_lost(), 3U);
  expect_well_after_reset();
}

TEST_F(GpioAxisFault, CorruptedEncoderIsAnEncoderFault) {
  bench_.emulator.set_fault(host::EmulatorFault::corrupted);
  bench_.ticks(3, kPush, motion_);
  expect_latched(kDeviceEncoderFault | kDeviceReferenceLost, GpioAxisTrouble::illegal_transition);
  EXPECT_GT(bench_.axis.illegal_transitions(), 0U);
}

TEST_F(GpioAxisFault, SilentEncoderUnderTorqueIsAFaultWithinItsTime) {
  bench_.emulator.set_fault(host::EmulatorFault::silent);
  int ticks = 0;
  while (bench_.torque() != 0.0 && ticks < 2000) {
    bench_.tick(kPush, motion_);
    ++ticks;
  }
  EXPECT_LE(ticks, 1002);
  expect_latched(kDeviceEncoderFault | kDeviceReferenceLost, GpioAxisTrouble::silent);
}

TEST_F(GpioAxisFault, AHandThatHoldsStillWithoutTorqueIsNoFault) {
  bench_.emulator.set_fault(host::EmulatorFault::silent);
  bench_.ticks(3000, kIdleOn, motion_);
  EXPECT_EQ(bench_.sample.status, kDeviceOk);
}

TEST_F(GpioAxisFault, ALateEncoderCannotBeToldFromALateHand) {
  bench_.emulator.set_fault(host::EmulatorFault::delayed);
  bench_.ticks(50, kIdleOn, motion_);
  EXPECT_EQ(bench_.sample.status, kDeviceOk);
  EXPECT_LE(std::abs(bench_.torque()), 0.04);
}

TEST_F(GpioAxisFault, UnpluggedChipIsALostDevice) {
  bench_.emulator.set_fault(host::EmulatorFault::unplugged);
  bench_.tick(kPush, motion_);
  expect_latched(kDeviceLost | kDeviceReferenceLost, GpioAxisTrouble::lines_gone);
  EXPECT_EQ(bench_.pwm.settings().duty_ns, 0) << "what can still be reached is off";
  EXPECT_EQ(bench_.axis.error().code, hal::ErrorCode::disconnected);
}

TEST_F(GpioAxisFault, FailingPwmStopsTheBridgeByItsEnable) {
  bench_.pwm.fail_next(1000, hal::ErrorCode::io);
  bench_.tick({.torque_Nm = 0.01, .enable = true}, motion_);
  EXPECT_FALSE(bench_.is_enabled()) << "in the same write";
  bench_.tick(kPush, motion_);
  expect_latched(kDeviceDriveFault, GpioAxisTrouble::pwm_fails);
}

TEST_F(GpioAxisFault, FailedCutIsTriedAgainUntilItIsDone) {
  bench_.pwm.fail_next(3, hal::ErrorCode::io);
  bench_.ticks(2, {}, motion_);
  EXPECT_NE(bench_.pwm.settings().duty_ns, 0);
  bench_.ticks(3, {}, motion_);
  EXPECT_EQ(bench_.pwm.settings().duty_ns, 0);
}

TEST_F(GpioAxisFault, APositionIsNoNewerThanTheLastGoodRead) {
  bench_.ticks(1, kPush, motion_);
  const hal::TimeNs last_ns = bench_.sample.time_ns;
  bench_.emulator.set_fault(host::EmulatorFault::unplugged);
  bench_.ticks(5, kPush, motion_);
  EXPECT_EQ(bench_.sample.time_ns, last_ns);
}

TEST_F(GpioAxisFault, LevelsThatNoEdgeExplainsEndThePosition) {
  bench_.lines.lose_next_edges(1);
  bench_.chip.drive(7, !bench_.chip.level(7));
  for (int i = 0; i < 7; ++i) {
    bench_.clock.advance_by(kBenchTick_ns);
    bench_.axis.read(std::span(&bench_.sample, 1), hal::kNoWait);
  }
  EXPECT_EQ(bench_.code(), code_of(GpioAxisTrouble::levels_disagree));
}

TEST(GpioAxisStart, RefusedLinesAreTold) {
  AxisBench bench;
  bench.axis.stop();
  bench.lines.release();
  hal::SimulatedGpioLines other(bench.chip);
  const std::array held{hal::GpioLineConfig{.offset = 7}};
  ASSERT_TRUE(other.request({.lines = held}));
  bench.axis.start();
  bench.axis.read(std::span(&bench.sample, 1), hal::kNoWait);
  EXPECT_NE(bench.sample.status & kDeviceLost, 0U);
  EXPECT_NE(bench.sample.status & kDeviceNotReady, 0U);
  EXPECT_EQ(bench.code(), code_of(GpioAxisTrouble::lines_fail));
  EXPECT_EQ(bench.axis.error().code, hal::ErrorCode::busy);
  bench.ticks(3, kPush);
  EXPECT_EQ(bench.torque(), 0.0);
  other.release();
  bench.axis.clear_faults();
  bench.ticks(3, kPush);
  EXPECT_EQ(bench.sample.status, kDeviceOk);
  EXPECT_GT(bench.torque(), 0.0);
}

TEST(GpioAxisStart, AnOpenEmergencyStopGetsNoPowerEvenBeforeTheFirstRead) {
  AxisBench bench;
  bench.axis.stop();
  bench.emulator.open_emergency_stop(true);
  bench.axis.start();
  bench.axis.write(std::span(&kPush, 1));
  EXPECT_FALSE(bench.is_enabled());
  EXPECT_EQ(bench.code(), code_of(GpioAxisTrouble::emergency_stop));
}

TEST(GpioAxisStart, ValuesOutOfRangeAreRefused) {
  GpioAxisConfig config = full_config();
  config.bridge.max_torque_Nm = 1.0;
  AxisBench bench(config);
  bench.ticks(3, kPush);
  EXPECT_EQ(bench.sample.status, kDeviceNotReady);
  EXPECT_EQ(bench.code(), code_of(GpioAxisTrouble::not_configured));
  EXPECT_EQ(bench.torque(), 0.0);
}

// A channel that never comes to rest: edges as fast as they can be read, for ever.
class FloodedLines final : public hal::GpioLines {
 private:
  hal::Result<void> DoRequest(const hal::GpioRequest&) override { return {}; }
  void DoRelease() override {}
  hal::Result<std::uint64_t> DoGet(std::uint64_t) override { return 0; }
  hal::Result<void> DoSet(std::uint64_t, std::uint64_t) override { return {}; }
  hal::Result<std::size_t> DoReadEdges(std::span<hal::GpioEdgeEvent> events, hal::TimeNs) override {
    for (hal::GpioEdgeEvent& event : events) {
      ++sequence_;
      event = {.time_ns = 2'000'000'000 + hal::TimeNs{sequence_} * 1000,
               .offset = sequence_ % 2 == 0 ? 7U : 3U,
               .sequence = sequence_,
               .rising = sequence_ % 4 < 2};
    }
    return events.size();
  }
  std::uint32_t sequence_ = 0;
};

TEST(GpioAxisFlood, EndsEveryReadAndIsAFault) {
  hal::SimulatedClock clock;
  hal::SimulatedPwmOutput pwm(clock);
  FloodedLines lines;
  GpioAxis axis(full_config(), lines, pwm, clock);
  axis.start();
  AxisSample sample;
  axis.read(std::span(&sample, 1), hal::kNoWait);
  EXPECT_EQ(sample.status, kDeviceStale | kDeviceEncoderFault | kDeviceReferenceLost);
  EXPECT_EQ(axis.trouble(0).code, code_of(GpioAxisTrouble::illegal_transition));
}

TEST(GpioAxisTroubleText, EveryNumberHasAStatusAndSaysWhatToDo) {
  using enum GpioAxisTrouble;
  for (const auto trouble :
       {edges_lost, illegal_transition, levels_disagree, index_moved, index_missing, jump, noise,
        silent, bridge_fault, limits_contradict, emergency_stop, safety_edges_lost, lines_gone,
        lines_fail, pwm_gone, pwm_fails, counter_gone, counter_fails, not_configured}) {
    EXPECT_NE(status_of(trouble), kDeviceOk);
    EXPECT_FALSE(describe(trouble).what.empty());
    EXPECT_FALSE(describe(trouble).remedy.empty());
    EXPECT_EQ(describe(trouble).code, code_of(trouble));
  }
  EXPECT_FALSE(describe(none));
}

}  // namespace
}  // namespace tactus::drivers
