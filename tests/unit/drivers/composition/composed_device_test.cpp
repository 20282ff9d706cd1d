#include "drivers/composition/composed_device.h"

#include <gtest/gtest.h>

#include <vector>

#include "hal/simulated/clock.h"

namespace tactus::drivers {
namespace {

// A board that a test plays: what it reads is set, what is written to it is kept.
class PlayedBoard {
 public:
  PlayedBoard(std::size_t axes, const hal::Clock& clock) : clock_(&clock), samples(axes) {
    for (AxisSample& sample : samples) {
      sample.status = kDeviceOk;
    }
  }

  [[nodiscard]] std::size_t axis_count() const { return samples.size(); }
  void start() { ++starts; }
  void read(std::span<AxisSample> out, hal::TimeNs deadline_ns) {
    deadlines_ns.push_back(deadline_ns);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      out[i] = samples[i];
      out[i].time_ns = clock_->now_ns() - late_ns;
    }
  }
  void write(std::span<const AxisCommand> commands) {
    written.assign(commands.begin(), commands.end());
  }
  void clear_faults() {
    ++clears;
    for (AxisSample& sample : samples) {
      sample.status = kDeviceOk;
    }
    words = {};
  }
  void stop() { ++stops; }
  [[nodiscard]] Trouble trouble(std::size_t axis) const {
    return samples[axis].status == kDeviceOk ? Trouble{} : words;
  }

 private:
  const hal::Clock* clock_;

 public:
  std::vector<AxisSample> samples;
  std::vector<AxisCommand> written;
  std::vector<hal::TimeNs> deadlines_ns;
  hal::TimeNs late_ns = 0;
  Trouble words;
  int starts = 0;
  int stops = 0;
  int clears = 0;
};
static_assert(Board<PlayedBoard>);

constexpr hal::TimeNs kReadLimit_ns = 500'000;

// Joint 1: motor and encoder on axis 0 of `drives`. Joint 2: motor on axis 1 of it, encoder on
// `encoders`, each with a gear of its own.
class TwoBoards : public ::testing::Test {
 protected:
  TwoBoards() {
    EXPECT_TRUE(device.add_board(BoardRef(drives)));
    EXPECT_TRUE(device.add_board(BoardRef(encoders)));
    EXPECT_TRUE(device.add_joint({.name = "first",
                                  .encoder = {0, 0},
                                  .motor = {0, 0},
                                  .transmission = {.motor_ratio = 10.0,
                                                   .encoder_ratio = 10.0,
                                                   .motor_direction = -1.0,
                                                   .encoder_direction = -1.0,
                                                   .offset = 0.5},
                                  .max_torque_Nm = 0.1}));
    EXPECT_TRUE(device.add_joint({.name = "second",
                                  .encoder = {1, 0},
                                  .motor = {0, 1},
                                  .transmission = {.motor_ratio = 4.0, .encoder_ratio = 1.0},
                                  .reference = {.kind = ReferenceKind::known_pose, .position = 0.2},
                                  .max_torque_Nm = 1.0}));
    device.start();
  }

  JointSample read() {
    JointSample sample;
    device.read(sample);
    return sample;
  }
  // Runs until the second joint is referenced where its encoder stands: it must stand still there.
  void home() {
    (void)read();
    for (int ms = 0; ms <= 501; ++ms) {
      (void)device.write({.home = true});
      (void)read();
      clock.advance_by(1'000'000);
    }
    EXPECT_EQ(read().status, kDeviceOk);
  }

  hal::SimulatedClock clock;
  PlayedBoard drives{2, clock};
  PlayedBoard encoders{1, clock};
  ComposedDevice device{clock, kReadLimit_ns};
};

TEST_F(TwoBoards, JointsAreTheShaftsThroughTheirGears) {
  encoders.samples[0].position_rad = 3.0;
  home();
  drives.samples[0].position_rad = 2.0;
  drives.samples[0].velocity_rad_per_s = -1.0;
  encoders.samples[0].position_rad = 3.1;
  const JointSample sample = read();
  EXPECT_DOUBLE_EQ(sample.position[0], 0.5 - 0.2);
  EXPECT_DOUBLE_EQ(sample.velocity[0], 0.1);
  EXPECT_DOUBLE_EQ(sample.position[1], 0.2 + 0.1);
}

TEST_F(TwoBoards, EffortsAreTorquesThroughTheGearsAndClamped) {
  home();
  EXPECT_EQ(device.write({.effort = {0.5, -2.0}, .enable = true}), kDeviceOk);
  ASSERT_EQ(drives.written.size(), 2U);
  EXPECT_TRUE(drives.written[0].enable);
  EXPECT_DOUBLE_EQ(drives.written[0].torque_Nm, -0.05);
  EXPECT_DOUBLE_EQ(drives.written[1].torque_Nm, -0.5);
  EXPECT_EQ(device.write({.effort = {50.0, 50.0}, .enable = true}), kDeviceOk);
  EXPECT_DOUBLE_EQ(drives.written[0].torque_Nm, -0.1);
  EXPECT_DOUBLE_EQ(drives.written[1].torque_Nm, 1.0);
}

TEST_F(TwoBoards, MotorsHaveNoPowerWithoutEnable) {
  home();
  (void)device.write({.effort = {0.5, 0.5}});
  EXPECT_FALSE(drives.written[0].enable);
  EXPECT_EQ(drives.written[0].torque_Nm, 0.0);
}

TEST_F(TwoBoards, UnreferencedJointIsNotReadyAndThenHoming) {
  EXPECT_EQ(read().status, kDeviceNotReady);
  encoders.samples[0].status = kDeviceNotReady;
  (void)device.write({.home = true});
  EXPECT_EQ(read().status, kDeviceNotReady | kDeviceHoming);
  encoders.samples[0].status = kDeviceOk;
  EXPECT_EQ(read().status, kDeviceHoming);
  home();
}

TEST_F(TwoBoards, ReadingHasOneDeadlineForAllBoards) {
  const hal::TimeNs now_ns = clock.now_ns();
  (void)read();
  EXPECT_EQ(drives.deadlines_ns.back(), now_ns + kReadLimit_ns);
  EXPECT_EQ(encoders.deadlines_ns.back(), now_ns + kReadLimit_ns);
}

TEST_F(TwoBoards, AgeIsThatOfTheOldestReferencedJoint) {
  encoders.late_ns = 7'000'000;
  EXPECT_EQ(read().age_us, 0U);  // the second joint's position is worth nothing yet
  home();
  EXPECT_EQ(read().age_us, 7000U);
}

TEST_F(TwoBoards, TroubleOfOneAxisTakesThePowerOfAllAndSaysWhichJoint) {
  home();
  encoders.samples[0].status = kDeviceEncoderFault;
  encoders.words = {"the encoder is gone", "plug it in", 17};
  EXPECT_NE(read().status & kDeviceEncoderFault, 0U);
  EXPECT_NE(device.write({.effort = {0.5, 0.5}, .enable = true}) & kDeviceEncoderFault, 0U);
  EXPECT_FALSE(drives.written[0].enable);
  EXPECT_EQ(drives.written[0].torque_Nm, 0.0);
  EXPECT_FALSE(drives.written[1].enable);
  EXPECT_EQ(device.trouble().joint, "second");
  EXPECT_EQ(device.trouble().trouble.what, "the encoder is gone");
}

TEST_F(TwoBoards, TroubleStaysLatchedWhenTheBoardIsWellAgain) {
  home();
  drives.samples[1].status = kDeviceDriveFault;
  drives.words = {"over temperature", "let it cool", 3};
  (void)read();
  drives.samples[1].status = kDeviceOk;
  EXPECT_NE(read().status & kDeviceDriveFault, 0U);
  EXPECT_EQ(device.trouble().trouble.code, 3U);
  device.clear_faults();
  EXPECT_EQ(drives.clears, 1);
  EXPECT_EQ(encoders.clears, 1);
  EXPECT_EQ(read().status, kDeviceOk);
  EXPECT_FALSE(device.trouble().trouble);
}

TEST_F(TwoBoards, LaterWordsOfTheSameJointReplaceTheFirst) {
  home();
  drives.samples[0].status = kDeviceLost;
  drives.words = {"the drive is silent", "look", 0};
  (void)read();
  drives.words = {"the link is down", "bring it up", 0};
  (void)read();
  EXPECT_EQ(device.trouble().trouble.what, "the link is down");
}

TEST_F(TwoBoards, LostEncoderLosesItsReferenceUnlessItIsAbsolute) {
  home();
  drives.samples[0].status = kDeviceLost;
  encoders.samples[0].status = kDeviceLost;
  (void)read();
  device.clear_faults();
  (void)device.write({});
  EXPECT_EQ(read().status, kDeviceNotReady);
  EXPECT_EQ(read().position[0], 0.5);
}

// The zero may move long after another fault: the loss is taken then, and once.
TEST_F(TwoBoards, ReferenceIsLostAlsoBesideAFaultThatIsLatchedAlready) {
  home();
  (void)device.write({});
  encoders.samples[0].status = kDeviceDriveFault;
  encoders.words = {"the drive restarted", "reset", 0};
  EXPECT_EQ(read().status, kDeviceDriveFault);
  encoders.samples[0].status = kDeviceDriveFault | kDeviceReferenceLost;
  EXPECT_EQ(read().status, kDeviceDriveFault | kDeviceReferenceLost | kDeviceNotReady);
  device.clear_faults();
  EXPECT_EQ(read().status, kDeviceNotReady);
  EXPECT_EQ(device.lost_reference().joint, "second");
  EXPECT_EQ(device.lost_reference().trouble.what, "the drive restarted");
  home();
  EXPECT_TRUE(device.lost_reference().joint.empty());
}

TEST_F(TwoBoards, LossOfAnAbsoluteEncodersZeroOrOfAMotorsCostsNothing) {
  home();
  drives.samples[0].status = kDeviceReferenceLost;  // absolute
  drives.samples[1].status = kDeviceReferenceLost;  // a motor whose encoder is another board's
  EXPECT_EQ(read().status, kDeviceOk);
}

TEST_F(TwoBoards, MeasuredTorqueIsAnEffortThroughTheGearWhereItIsKnown) {
  home();
  drives.samples[0].torque_Nm = 0.02;
  drives.samples[0].has_torque = true;
  drives.samples[1].torque_Nm = 7.0;
  const JointSample sample = read();
  EXPECT_EQ(sample.effort_known, 1U);
  EXPECT_DOUBLE_EQ(sample.effort[0], -0.2);
  EXPECT_EQ(sample.effort[1], 0.0);
}

TEST_F(TwoBoards, AMeasuredTorqueIsNewInTheSampleAfterItCame) {
  home();
  drives.samples[0].has_torque = true;
  drives.samples[0].torque_time_ns = 5;
  EXPECT_EQ(read().effort_is_new, 1U);
  EXPECT_EQ(read().effort_is_new, 0U);
  EXPECT_EQ(read().effort_known, 1U);
  drives.samples[0].torque_time_ns = 6;
  EXPECT_EQ(read().effort_is_new, 1U);
}

TEST_F(TwoBoards, PowerGoesOffForAFaultOfTheControllerAndOfTheDevice) {
  home();
  (void)device.write({});
  EXPECT_FALSE(drives.written[0].power_off);
  (void)device.write({.effort = {0.5, 0.5}, .enable = true, .power_off = true});
  EXPECT_TRUE(drives.written[0].power_off);
  EXPECT_FALSE(drives.written[0].enable);
  EXPECT_EQ(drives.written[0].torque_Nm, 0.0);
  drives.samples[1].status = kDeviceDriveFault;
  (void)read();
  (void)device.write({});
  EXPECT_TRUE(drives.written[0].power_off);
}

TEST_F(TwoBoards, StartAndStopReachEveryBoard) {
  EXPECT_EQ(drives.starts, 1);
  EXPECT_EQ(encoders.starts, 1);
  device.stop();
  EXPECT_EQ(drives.stops, 1);
  EXPECT_EQ(encoders.stops, 1);
}

TEST(ComposedDevice, WiringThatNamesNoAxisIsRefused) {
  hal::SimulatedClock clock;
  PlayedBoard board(2, clock);
  ComposedDevice device(clock, kReadLimit_ns);
  ASSERT_TRUE(device.add_board(BoardRef(board)));
  EXPECT_FALSE(device.add_joint({.encoder = {0, 2}, .motor = {0, 0}}));
  EXPECT_FALSE(device.add_joint({.encoder = {0, 0}, .motor = {1, 0}}));
  EXPECT_FALSE(device.add_joint({.transmission = {.motor_ratio = 0.0}}));
  EXPECT_FALSE(device.add_board(BoardRef()));
  EXPECT_TRUE(device.add_joint({}));
}

TEST(ComposedDevice, MotorThatHomesMovesOnlyWhileHomeIsWanted) {
  hal::SimulatedClock clock;
  PlayedBoard board(1, clock);
  ComposedDevice device(clock, kReadLimit_ns);
  ASSERT_TRUE(device.add_board(BoardRef(board)));
  ASSERT_TRUE(device.add_joint({.reference = {.kind = ReferenceKind::hard_stop,
                                              .position = 1.0,
                                              .search_effort = 0.05,
                                              .lower = -1.0,
                                              .upper = 1.0},
                                .max_torque_Nm = 1.0}));
  device.start();
  JointSample sample;
  device.read(sample);
  (void)device.write({.home = true});
  device.read(sample);
  EXPECT_EQ(sample.status, kDeviceHoming);
  (void)device.write({.home = true});
  EXPECT_TRUE(board.written[0].enable);
  EXPECT_GT(board.written[0].torque_Nm, 0.0);
  EXPECT_LE(board.written[0].torque_Nm, 0.05);
  (void)device.write({});
  EXPECT_FALSE(board.written[0].enable);
  EXPECT_EQ(board.written[0].torque_Nm, 0.0);
}

}  // namespace
}  // namespace tactus::drivers
