#include "firmware/safety/encoder_guard.h"

#include <gtest/gtest.h>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

class EncoderGuardTest : public ::testing::Test {
 protected:
  EncoderGuardTest() { guard_.configure(cartesian_config()); }  // 1 kHz, 100 m/s, 10 N

  std::uint64_t check(double position, double velocity = 0.0, double effort = 0.0,
                      std::uint32_t missed = 0) {
    drivers::JointSample sample;
    sample.position[1] = position;
    sample.velocity[1] = velocity;
    return guard_.check(sample, {0.0, effort, 0.0}, missed);
  }

  EncoderGuard guard_;
};

TEST_F(EncoderGuardTest, AStepFurtherThanAJointCanGoIsAJump) {
  EXPECT_EQ(check(0.0), kNoFault);
  EXPECT_EQ(check(0.099), kNoFault);
  EXPECT_EQ(check(-0.002), kFaultEncoderJump);
  EXPECT_EQ(check(-0.002), kNoFault) << "the new place is where it is from then on";
}

TEST_F(EncoderGuardTest, TicksWithoutASampleGiveAJointTheirTime) {
  check(0.0);
  guard_.pass();
  EXPECT_EQ(check(0.199), kNoFault);
  EXPECT_EQ(check(0.0, 0.0, 0.0, 1), kNoFault);
  EXPECT_EQ(check(0.199), kFaultEncoderJump);
}

TEST_F(EncoderGuardTest, AnotherZeroIsNoJump) {
  check(0.0);
  guard_.rest();
  EXPECT_EQ(check(5.0), kNoFault);
}

TEST_F(EncoderGuardTest, AVelocityWithoutAChangeOfPositionIsAFrozenEncoder) {
  check(0.1);
  for (int tick = 0; tick < 49; ++tick) {
    EXPECT_EQ(check(0.1, -1.0), kNoFault) << tick;
  }
  EXPECT_EQ(check(0.1 + 1e-9, -1.0), kNoFault) << "one count is a sign of life";
  for (int tick = 0; tick < 49; ++tick) {
    EXPECT_EQ(check(0.1 + 1e-9, -1.0), kNoFault) << tick;
  }
  check(0.1 + 1e-9, -1.0);
  EXPECT_EQ(check(0.1 + 1e-9, -1.0), kFaultEncoderFrozen);
}

TEST_F(EncoderGuardTest, AChangeOfEffortThatMovesNothingForHalfASecondIsAFault) {
  check(0.1);
  for (int tick = 0; tick < 499; ++tick) {
    EXPECT_EQ(check(0.1, 0.0, -5.1), kNoFault) << tick;
  }
  EXPECT_EQ(check(0.1, 0.0, -5.1), kFaultTorqueWithoutMotion);
}

TEST_F(EncoderGuardTest, AHandThatHoldsAConstantForceMayHoldStill) {
  check(0.1);
  check(0.1001, 0.0, 9.0);
  for (int tick = 0; tick < 2000; ++tick) {
    EXPECT_EQ(check(0.1001, 0.0, 9.0), kNoFault) << tick;
  }
}

}  // namespace
}  // namespace tactus::firmware
