#include "drivers/homing.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tactus::drivers {
namespace {

constexpr hal::TimeNs kMillisecond_ns = 1'000'000;
constexpr Transmission kGeared{.motor_ratio = 10.0, .encoder_ratio = 10.0};

// A joint of its own mass and friction between two stops, its encoder ten times as fast and
// counting from anywhere.
class SlidingJoint {
 public:
  explicit SlidingJoint(double position) : position_(position) {}

  AxisSample sample() const {
    return {.position_rad = 10.0 * (position_ - 0.3),
            .velocity_rad_per_s = 10.0 * speed_,
            .status = kDeviceOk};
  }
  void push(double effort, double seconds) {
    speed_ += seconds / 0.05 * (effort - 0.2 * speed_);
    position_ += seconds * speed_;
    if (position_ <= -0.5 || position_ >= 0.5) {
      position_ = std::clamp(position_, -0.5, 0.5);
      speed_ = 0.0;
    }
  }
  [[nodiscard]] double position() const { return position_; }
  [[nodiscard]] double speed() const { return speed_; }

 private:
  double position_;
  double speed_ = 0.0;
};

TEST(Homing, AbsoluteEncoderIsReferencedAtOnceAndForGood) {
  Homing homing({.kind = ReferenceKind::absolute}, {.offset = 0.25});
  EXPECT_TRUE(homing.is_referenced());
  homing.lose();
  EXPECT_TRUE(homing.is_referenced());
  EXPECT_EQ(joint_position(homing.transmission(), 1.0), 1.25);
}

TEST(Homing, KnownPoseIsTakenWhenHomeIsAskedFor) {
  Homing homing({.kind = ReferenceKind::known_pose, .position = 0.1}, kGeared);
  const AxisSample sample{.position_rad = 7.0, .status = kDeviceOk};
  homing.advance(sample, false, 0);
  EXPECT_FALSE(homing.is_referenced());
  homing.advance(sample, true, kMillisecond_ns);
  ASSERT_TRUE(homing.is_referenced());
  EXPECT_DOUBLE_EQ(joint_position(homing.transmission(), 7.0), 0.1);
  EXPECT_DOUBLE_EQ(joint_position(homing.transmission(), 8.0), 0.2);
}

TEST(Homing, IndexThatTheUserPassesOverIsTheReference) {
  Homing homing({.kind = ReferenceKind::index, .position = -0.2}, kGeared);
  AxisSample sample{.position_rad = 3.0, .status = kDeviceOk};
  homing.advance(sample, true, 0);
  EXPECT_TRUE(homing.is_searching());
  EXPECT_EQ(homing.effort(), 0.0);
  sample.index_seen = true;
  sample.index_rad = 4.0;
  sample.position_rad = 5.0;
  homing.advance(sample, true, kMillisecond_ns);
  ASSERT_TRUE(homing.is_referenced());
  EXPECT_DOUBLE_EQ(joint_position(homing.transmission(), 5.0), -0.1);
}

TEST(Homing, MotorFindsTheHardStopAndNeverPushesHarderThanAllowed) {
  for (const double way : {-1.0, 1.0}) {
    SlidingJoint joint(0.1);
    Homing homing({.kind = ReferenceKind::hard_stop,
                   .position = way * 0.5,
                   .search_effort = way * 0.04,
                   .search_speed = 0.3},
                  kGeared);
    hal::TimeNs now_ns = 0;
    while (!homing.is_referenced() && now_ns < 10'000 * kMillisecond_ns) {
      homing.advance(joint.sample(), true, now_ns);
      EXPECT_LE(std::abs(homing.effort()), 0.04);
      EXPECT_LE(std::abs(joint.speed()), 0.31);
      joint.push(homing.effort(), 1e-3);
      now_ns += kMillisecond_ns;
    }
    ASSERT_TRUE(homing.is_referenced());
    EXPECT_EQ(homing.effort(), 0.0);
    EXPECT_NEAR(joint_position(homing.transmission(), joint.sample().position_rad),
                joint.position(), 1e-12);
    EXPECT_NEAR(joint.position(), way * 0.5, 1e-12);
  }
}

TEST(Homing, SearchThatFindsNothingEndsWithAReason) {
  Homing homing({.kind = ReferenceKind::index, .search_effort = 0.1, .time_limit_s = 1.0}, kGeared);
  const AxisSample sample{.velocity_rad_per_s = 5.0, .status = kDeviceOk};
  for (hal::TimeNs now_ns = 0; now_ns <= 1002 * kMillisecond_ns; now_ns += kMillisecond_ns) {
    homing.advance(sample, true, now_ns);
  }
  EXPECT_FALSE(homing.is_searching());
  EXPECT_EQ(homing.effort(), 0.0);
  EXPECT_TRUE(homing.trouble());
  homing.lose();
  EXPECT_FALSE(homing.trouble());
}

TEST(Homing, SearchThatIsWithdrawnLetsGo) {
  Homing homing({.kind = ReferenceKind::hard_stop, .search_effort = 0.1}, kGeared);
  homing.advance({.status = kDeviceOk}, true, 0);
  homing.advance({.status = kDeviceOk}, true, kMillisecond_ns);
  EXPECT_GT(homing.effort(), 0.0);
  homing.advance({.status = kDeviceOk}, false, 2 * kMillisecond_ns);
  EXPECT_EQ(homing.effort(), 0.0);
  EXPECT_FALSE(homing.is_searching());
}

TEST(Homing, CheckNamesTheField) {
  EXPECT_EQ(check(Reference{.kind = ReferenceKind::hard_stop}).error().field, "search_effort");
  EXPECT_EQ(check(Reference{.search_speed = 0.0}).error().field, "search_speed");
  EXPECT_EQ(check(Reference{.time_limit_s = 1e9}).error().field, "time_limit_s");
  EXPECT_TRUE(check(Reference{}));
}

}  // namespace
}  // namespace tactus::drivers
