#include "firmware/safety/motion_guard.h"

#include <gtest/gtest.h>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

const Vec3 kRight = Vec3::UnitX();
const Vec3 kUp = Vec3::UnitY();

class MotionGuardTest : public ::testing::Test {
 protected:
  MotionGuardTest() { guard_.configure({}); }  // 1 kHz; 5 m/s; 0.25 m at 2.5 m/s
  MotionGuard guard_;
};

TEST_F(MotionGuardTest, AToolFasterThanAHandIsAFaultAtOnce) {
  EXPECT_EQ(guard_.check(4.99 * kRight, kRight), kNoFault);
  EXPECT_EQ(guard_.check(5.01 * kRight, kRight), kFaultOverspeed);
}

TEST_F(MotionGuardTest, ARunawayIsFastMotionThatTheForceDoesNotMake) {
  int ticks = 0;
  while (guard_.check(3.0 * kRight, -kRight) == kNoFault && ticks < 1000) {
    ++ticks;
  }
  EXPECT_EQ(ticks, 83);  // 3 mm a tick: the 84th passes 250 mm
  guard_.rest();
  for (ticks = 0; ticks < 1000; ++ticks) {
    EXPECT_EQ(guard_.check(3.0 * kRight, kRight), kNoFault) << "pushed";
    EXPECT_EQ(guard_.check(2.4 * kRight, -kRight), kNoFault) << "a hand's motion";
  }
}

TEST_F(MotionGuardTest, ForceAlongAFastMotionIsTakenAwayAndTheRestIsKept) {
  const Vec3 force = 2.0 * kRight + 3.0 * kUp;
  EXPECT_EQ(guard_.slow(force, 2.4 * kRight).force_W, force);
  const SlowedForce half = guard_.slow(force, 3.75 * kRight);
  EXPECT_TRUE(half.force_W.isApprox(kRight + 3.0 * kUp, 1e-12));
  EXPECT_EQ(half.limits, kLimitSpeed);
  EXPECT_TRUE(guard_.slow(force, 9.0 * kRight).force_W.isApprox(3.0 * kUp, 1e-12));
  EXPECT_EQ(guard_.slow(force, -3.75 * kRight).force_W, force) << "what brakes is never taken";
}

}  // namespace
}  // namespace tactus::firmware
