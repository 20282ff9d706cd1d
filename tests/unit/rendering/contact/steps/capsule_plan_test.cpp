#include "rendering/contact/capsule_plan.h"

#include <gtest/gtest.h>

namespace tactus::rendering {
namespace {

// Follows a straight path from capsule to capsule, with so many tests in each gathering.
Capsule after_straight_path(CapsulePlan& plan, int gatherings, std::size_t tests) {
  Capsule capsule = plan.next(Vec3::Zero(), Vec3::Zero());
  for (int i = 0; i < gatherings; ++i) {
    plan.learn(tests, true);
    const double step_m = std::max(capsule.axis.norm(), 0.0002);
    capsule = plan.next(capsule.start, capsule.start + Vec3{step_m, 0.0, 0.0});
  }
  return capsule;
}

TEST(CapsulePlan, PointsWhereTheProxyGoes) {
  CapsulePlan plan;
  const Capsule capsule = after_straight_path(plan, 5, 128);
  EXPECT_TRUE(capsule.axis.normalized().isApprox(Vec3::UnitX(), 1e-12));
}

TEST(CapsulePlan, BecomesSlimOnAStraightPathAndStoutOnACrookedOne) {
  CapsulePlan plan;
  const Capsule slim = after_straight_path(plan, 20, 128);
  EXPECT_GT(slim.axis.norm() / slim.radius, 15.0);
  Capsule capsule = slim;
  for (int i = 0; i < 20; ++i) {  // leaves through the side
    capsule = plan.next(capsule.start, capsule.start + Vec3{0.0, 2 * capsule.radius, 0.0});
  }
  EXPECT_LT(capsule.axis.norm() / capsule.radius, 5.0);
}

TEST(CapsulePlan, BecomesShorterInADensePlaceAndLongerInASparseOne) {
  CapsulePlan dense;
  CapsulePlan sparse;
  const double middle_m = after_straight_path(sparse, 3, 128).axis.norm();
  EXPECT_GE(after_straight_path(sparse, 10, 20).axis.norm(), 2 * middle_m);
  EXPECT_LE(after_straight_path(dense, 10, 4000).axis.norm(), middle_m);
}

TEST(CapsulePlan, HasNoDirectionAfterAJump) {
  CapsulePlan plan;
  after_straight_path(plan, 5, 128);
  EXPECT_EQ(plan.next(Vec3::Zero(), {1.0, 0.0, 0.0}).axis, Vec3::Zero());
}

TEST(CapsulePlan, IsStoutAndTwiceAsLongWhereOneTickNeedsAnother) {
  CapsulePlan plan;
  const Capsule before = after_straight_path(plan, 12, 400);
  const Capsule next = plan.next(before.start, before.start + before.axis, true);
  EXPECT_NEAR(next.axis.norm(), 2.0 * before.axis.norm(), 1e-9);
  EXPECT_NEAR(next.axis.norm() / next.radius, 4.0, 1e-9);
}

TEST(CapsulePlan, IsHalvedForWantOfRoom) {
  CapsulePlan plan;
  const Capsule before = after_straight_path(plan, 12, 24);
  plan.halve();
  const Vec3 next = before.start + before.axis;
  EXPECT_LT(plan.next(before.start, next).axis.norm(), 0.6 * before.axis.norm());
}

}  // namespace
}  // namespace tactus::rendering
