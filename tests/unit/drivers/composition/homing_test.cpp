#include "drivers/composition/homing.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

constexpr hal::TimeNs kMillisecond_ns = 1'000'000;
constexpr Transmission kGeared{.motor_ratio = 10.0, .encoder_ratio = 10.0};

TEST(Homing, AbsoluteEncoderIsReferencedAtOnceAndForGood) {
  Homing homing({.kind = ReferenceKind::absolute}, {.offset = 0.25});
  EXPECT_TRUE(homing.is_referenced());
  homing.lose();
  EXPECT_TRUE(homing.is_referenced());
  EXPECT_EQ(joint_position(homing.transmission(), 1.0), 1.25);
}

TEST(Homing, KnownPoseIsTakenAfterHalfASecondOfStandingStill) {
  Homing homing({.kind = ReferenceKind::known_pose, .position = 0.1}, kGeared);
  const AxisSample sample{.position_rad = 7.0, .status = kDeviceOk};
  homing.advance(sample, false, 0);
  EXPECT_FALSE(homing.is_referenced());
  for (int ms = 1; ms < 501; ++ms) {
    homing.advance(sample, true, ms * kMillisecond_ns);
    ASSERT_FALSE(homing.is_referenced()) << ms;
    ASSERT_EQ(homing.effort(), 0.0);
  }
  homing.advance(sample, true, 501 * kMillisecond_ns);
  ASSERT_TRUE(homing.is_referenced());
  EXPECT_DOUBLE_EQ(joint_position(homing.transmission(), 7.0), 0.1);
  EXPECT_DOUBLE_EQ(joint_position(homing.transmission(), 8.0), 0.2);
}

TEST(Homing, MovingJointIsNoKnownPoseAndAStaleOneShowsNothing) {
  const Reference pose{
      .kind = ReferenceKind::known_pose, .time_limit_s = 3.0, .lower = -1.0, .upper = 1.0};
  Homing moving(pose, {});
  Homing stale(pose, {});
  for (int ms = 0; ms <= 3001; ++ms) {
    moving.advance({.position_rad = 1e-4 * ms, .status = kDeviceOk}, true, ms * kMillisecond_ns);
    stale.advance({.status = kDeviceStale}, true, ms * kMillisecond_ns);
    ASSERT_FALSE(moving.is_referenced());
    ASSERT_FALSE(stale.is_referenced());
  }
  EXPECT_EQ(moving.trouble().what, "homing: the joint was not held still in its known pose");
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
  EXPECT_NEAR(joint_position(homing.transmission(), 5.0), -0.1, 1e-15);
}

TEST(Homing, IndexFromBeforeTheSearchIsNotTaken) {
  Homing homing({.kind = ReferenceKind::index, .position = -0.2}, kGeared);
  AxisSample sample{.position_rad = 3.0, .status = kDeviceOk, .index_rad = 4.0, .index_seen = true};
  for (int ms = 0; ms < 100; ++ms) {
    homing.advance(sample, true, ms * kMillisecond_ns);
    ASSERT_FALSE(homing.is_referenced());
  }
  sample.index_rad = 10.0;
  homing.advance(sample, true, 100 * kMillisecond_ns);
  ASSERT_TRUE(homing.is_referenced());
  EXPECT_NEAR(joint_position(homing.transmission(), 10.0), -0.2, 1e-12);
}

TEST(Homing, IndexThatPutsTheJointOutsideItsLimitsIsRefused) {
  Homing homing({.kind = ReferenceKind::index, .lower = -1.0, .upper = 1.0}, {});
  homing.advance({.status = kDeviceOk}, true, 0);
  homing.advance({.position_rad = 3.0, .status = kDeviceOk, .index_rad = 0.5, .index_seen = true},
                 true, kMillisecond_ns);
  EXPECT_FALSE(homing.is_referenced());
  EXPECT_EQ(homing.trouble().what, "homing: the index would put the joint outside its limits");
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
  Homing homing({.kind = ReferenceKind::hard_stop,
                 .position = 1.0,
                 .search_effort = 0.1,
                 .lower = -1.0,
                 .upper = 1.0},
                kGeared);
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
  EXPECT_EQ(check(Reference{.lower = 1.0, .upper = 1.0}).error().field, "lower");
  EXPECT_EQ(check(Reference{.min_travel = -1.0}).error().field, "min_travel");
  EXPECT_EQ(check(Reference{.kind = ReferenceKind::hard_stop,
                            .position = -1.0,
                            .search_effort = 0.1,
                            .lower = -1.0,
                            .upper = 1.0})
                .error()
                .field,
            "search_effort");
  EXPECT_TRUE(check(Reference{}));
}

}  // namespace
}  // namespace tactus::drivers
