#include "drivers/haply_serial/haply.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "hal/simulated/serial_port.h"
#include "tests/unit/drivers/haply_serial/haply_rig.h"
#include "tests/unit/drivers/transcript.h"

namespace tactus::drivers {
namespace {

// Plays the board's side of a transcript.
class HaplyPlayer {
 public:
  HaplyPlayer() : driver_(host_, clock_, pantograph_config()) {
    host_.connect(board_);
    driver_.start();
  }

  void play(const std::string& name) {
    for (const TranscriptLine& line : transcript(name)) {
      SCOPED_TRACE(name + ":" + std::to_string(line.number));
      play(line);
    }
  }

 private:
  void play(const TranscriptLine& line) {
    if (line.word == "host") {
      const auto expected = hex_bytes(line.rest);
      std::vector<std::byte> heard(expected.size());
      if (!board_.read_all(heard, hal::kNoWait)) {
        driver_.read(samples_, clock_.now_ns());
        driver_.write(commands_);
        ASSERT_TRUE(board_.read_all(heard, hal::kNoWait));
      }
      EXPECT_EQ(heard, expected);
    } else if (line.word == "board") {
      const auto answer = hex_bytes(line.rest);
      ASSERT_TRUE(board_.write(answer, hal::kNoWait));
      clock_.advance_by(HaplyRig::kTick_ns);
    } else if (line.word == "settle") {
      clock_.advance_by(25'000'000);
      driver_.read(samples_, clock_.now_ns());
    } else if (line.word == "ready") {
      driver_.read(samples_, clock_.now_ns());
      EXPECT_EQ(samples_[0].status, kDeviceOk);
    } else if (line.word == "torque") {
      std::istringstream words(line.rest);
      commands_[0].enable = commands_[1].enable = true;
      words >> commands_[0].torque_Nm >> commands_[1].torque_Nm;
    } else {
      FAIL() << "unknown word " << line.word;
    }
  }

  hal::SimulatedClock clock_;
  hal::SimulatedSerialPort host_{clock_};
  hal::SimulatedSerialPort board_{clock_};
  Haply driver_;
  std::array<AxisSample, kHaplyMaxAxes> samples_{};
  std::array<AxisCommand, kHaplyMaxAxes> commands_{};
};

TEST(Haply, FollowsTheTranscriptOfASession) {
  HaplyPlayer().play("haply_session.txt");
}

TEST(Haply, TellsTheArmsAnglesToHalfACount) {
  HaplyRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 100));
  for (int tick = 0; tick < 500; ++tick) {
    const double first = std::numbers::pi - 0.4 * std::sin(0.02 * tick);
    const double second = 0.5 * std::sin(0.01 * tick);
    rig.board().shafts()[0].position_rad = first;
    rig.board().shafts()[1].position_rad = second;
    rig.driver.write(rig.commands);
    const hal::TimeNs sent_ns = rig.clock.now_ns();
    rig.clock.advance_by(HaplyRig::kTick_ns);
    rig.driver.read(rig.samples, rig.clock.now_ns());
    ASSERT_EQ(rig.samples[0].status, kDeviceOk);
    ASSERT_NEAR(rig.samples[0].position_rad, first, std::numbers::pi / 13'824.0 + 1e-6);
    ASSERT_NEAR(rig.samples[1].position_rad, second, std::numbers::pi / 13'824.0 + 1e-6);
    ASSERT_EQ(rig.samples[1].time_ns, sent_ns);
  }
}

TEST(Haply, TorqueReachesTheArmClampedTwice) {
  HaplyRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 100));
  rig.commands[0] = {.torque_Nm = 0.05, .enable = true};
  rig.commands[1] = {.torque_Nm = -7.0, .enable = true};
  rig.ticks(2);
  EXPECT_NEAR(rig.board().shafts()[0].torque_Nm, 0.05, 1e-7);
  EXPECT_NEAR(rig.board().shafts()[1].torque_Nm, -0.123, 1e-7);
  rig.commands[0].torque_Nm = std::numeric_limits<double>::quiet_NaN();
  rig.commands[1].enable = false;
  rig.ticks(2);
  EXPECT_TRUE(rig.arms_feel_nothing());
}

TEST(Haply, ConfiguredLimitHoldsBelowTheBoards) {
  HaplyConfig config = pantograph_config();
  config.torque_limit_Nm = 0.03;
  HaplyRig rig(config);
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 100));
  rig.command(1.0);
  rig.ticks(2);
  EXPECT_NEAR(rig.board().shafts()[0].torque_Nm, 0.03, 1e-7);
}

TEST(Haply, ServesFourAxesEachWithItsSenseOfTurning) {
  HaplyConfig config;
  config.unproven_watchdog = true;
  config.axes = 4;
  config.axis[2] = {.motor_counter_clockwise = true, .encoder_counter_clockwise = true};
  config.axis[3].counts_per_turn = 1000.0;
  HaplyRig rig(config);
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 100));
  for (int tick = 0; tick < 100; ++tick) {
    rig.board().shafts()[2].position_rad -= 0.002;
    rig.board().shafts()[3].position_rad += 0.002;
    rig.tick();
  }
  rig.command(0.1);
  rig.ticks(2);
  EXPECT_NEAR(rig.samples[2].position_rad, 0.2, 0.001);
  EXPECT_NEAR(rig.samples[3].position_rad, 0.2, 0.004);
  EXPECT_NEAR(rig.board().shafts()[2].torque_Nm, -0.1, 1e-7);
  EXPECT_NEAR(rig.board().shafts()[3].torque_Nm, 0.1, 1e-7);
}

TEST(Haply, StartsCleanWhateverTheBoardWasDoing) {
  HaplyRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 100));
  rig.command(0.1);
  rig.ticks(3);
  rig.commands.fill({});
  rig.driver.start();  // as a new program would, with torque on the motors
  rig.clock.advance_by(100'000);
  EXPECT_TRUE(rig.arms_feel_nothing());
  rig.tick();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 100));
  EXPECT_EQ(rig.board().setups(), 4U);  // two at each start
  EXPECT_EQ(rig.board().unknown_commands(), 0U);
}

TEST(Haply, StoppingTakesTheTorqueAway) {
  HaplyRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 100));
  rig.command(0.1);
  rig.ticks(3);
  ASSERT_FALSE(rig.arms_feel_nothing());
  rig.driver.stop();
  rig.ticks(2);
  EXPECT_TRUE(rig.arms_feel_nothing());
  EXPECT_EQ(rig.board().motors(), 0U);
  EXPECT_EQ(rig.samples[0].status, kDeviceNotReady);
}

TEST(Haply, OneCommandIsOneWrite) {
  HaplyRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 100));
  const auto before = rig.board().commands();
  rig.ticks(1000);
  EXPECT_EQ(rig.board().commands() - before, 1000U);
  EXPECT_EQ(rig.board().unknown_commands(), 0U);
}

}  // namespace
}  // namespace tactus::drivers
