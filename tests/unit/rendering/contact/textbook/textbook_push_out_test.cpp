// The textbook's god-objects with and without a push-out, with friction, and at their limits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "rendering/contact/textbook/textbook_proxy.h"
#include "rendering/limits.h"
#include "tests/support/connected_solid.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/contact/textbook/textbook_course.h"

namespace tactus::rendering {
namespace {

using testing::kAllRules;
using testing::kFloatRounding_m;
using testing::kPushOut_m;
using testing::kRough;
using testing::kSlippery;
using testing::Shape;
using testing::share_of;
using testing::textbook_plate;
using testing::TextbookCourse;

TEST(TextbookProxy, FallsThroughByRoundingWithoutAPushOut) {
  // Pressed and slid along a plate whose normal has no axis of the frame.
  const Vec3 axis(1.0, 2.0, 3.0);
  const Shape tilted = testing::turned(textbook_plate(), axis, 0.7);
  const Mat3 turn = Eigen::AngleAxisd(0.7, axis.normalized()).toRotationMatrix();
  for (const TextbookRule rule : kAllRules) {
    SCOPED_TRACE(static_cast<int>(rule));
    int first_fall = -1;
    for (const double push_out_m : {0.0, kPushOut_m}) {
      TextbookCourse course(tilted, Sides::one, rule, push_out_m, kSlippery,
                            turn * Vec3{-0.02, 0.001, 0.0013});
      bool has_held = true;
      for (int k = 0; k < 1000 && has_held; ++k) {
        const TextbookRest rest = course.move(turn * Vec3{-0.02 + 3e-5 * k, -0.001, 0.0013});
        has_held = rest.planes > 0 && course.height_over_convex(rest.proxy) > -1e-6;
        first_fall = has_held ? first_fall : k;
      }
      EXPECT_EQ(has_held, push_out_m > 0.0) << push_out_m;
    }
    EXPECT_GT(first_fall, 0);
    EXPECT_LT(first_fall, 100);
  }
}

// The god-object is in front of the plane of the facet that it was put above, and a convex solid is
// behind the planes of all its facets. So no rule can enter one, rounding of the planes apart.
TEST(TextbookProxy, StaysOutOfAConvexSolidByEveryRule) {
  constexpr int kTextbookTicks = 100'000;
  constexpr double kRadius_m = 0.03;
  for (const TextbookRule rule : kAllRules) {
    SCOPED_TRACE(static_cast<int>(rule));
    TextbookCourse course(testing::icosphere(kRadius_m, 1), Sides::one, rule, kPushOut_m, kRough,
                          {0.0, 0.05, 0.0});
    std::mt19937_64 random(71);
    std::normal_distribution<double> normal;
    Vec3 tool(0.0, 0.05, 0.0);
    Vec3 target = tool;
    double step_m = 1e-3;
    int contacts = 0;
    for (int k = 0; k < share_of(kTextbookTicks); ++k) {
      if ((target - tool).norm() < step_m) {
        const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
        target = kRadius_m * (0.9 + 0.15 * normal(random)) * direction;
        step_m = 1e-5 * std::exp(std::abs(1.5 * normal(random)));
      }
      tool += step_m * (target - tool).normalized();
      const TextbookRest rest = course.move(tool);
      contacts += rest.planes > 0 ? 1 : 0;
      ASSERT_GT(course.height_over_convex(rest.proxy), -1e-9) << "tick " << k;
    }
    EXPECT_GT(contacts, share_of(kTextbookTicks) / 4);
  }
}

TEST(TextbookProxy, GoesThroughTheOtherWallOfASlotThatIsNarrowerThanThePushOut) {
  constexpr double kGap_m = 5e-4;
  for (const TextbookRule rule : kAllRules) {
    SCOPED_TRACE(static_cast<int>(rule));
    for (const double push_out_m : {1e-4, 1e-3}) {
      TextbookCourse course(testing::slotted_block(kGap_m, 0.01), Sides::one, rule, push_out_m,
                            kSlippery, {0.0, -0.005, 0.0013});
      const TextbookRest rest = course.move({-0.002, -0.005, 0.0013});
      if (rule == TextbookRule::three_sub_goals && push_out_m > kGap_m) {
        // The segment to its sub-goal meets the other wall: the planes contradict each other.
        EXPECT_EQ(rest.planes, 2);
        continue;
      }
      EXPECT_EQ(rest.planes, 1);
      EXPECT_NEAR(rest.proxy.x(), -0.5 * kGap_m + push_out_m, kFloatRounding_m);
      EXPECT_NEAR(testing::winding_number(course.shape(), rest.proxy),
                  push_out_m > kGap_m ? 1.0 : 0.0, 1e-6);
    }
  }
}

TEST(TextbookProxy, SticksWithinTheStaticCircleAndSlipsToTheRimOfTheDynamicOne) {
  constexpr double kDepth_m = 0.002;
  constexpr double kPressure_m = kDepth_m + kPushOut_m;
  for (const TextbookRule rule :
       {TextbookRule::one_plane, TextbookRule::three_sub_goals, TextbookRule::three_step}) {
    TextbookCourse course(textbook_plate(), Sides::one, rule, kPushOut_m, kRough,
                          {0.0, 0.001, 0.0013});
    const auto at = [&](double x) { return course.move({x, -kDepth_m, 0.0013}); };
    at(0.0);
    constexpr double kStep_m = 1e-5;
    double x = 0.0;
    for (; x < 0.6 * kPressure_m - kStep_m; x += kStep_m) {
      const TextbookRest rest = at(x);
      ASSERT_EQ(rest.friction, FrictionState::stick) << x;
      ASSERT_NEAR(rest.proxy.x(), 0.0, 1e-14);
      ASSERT_NEAR(rest.proxy.y(), kPushOut_m, 1e-15);
    }
    for (x += kStep_m; x < 0.01; x += kStep_m) {
      const TextbookRest rest = at(x);
      ASSERT_EQ(rest.friction, FrictionState::slip) << x;
      ASSERT_NEAR(rest.proxy.x(), x - 0.4 * kPressure_m, 1e-8);
    }
    const double held = at(x).proxy.x();
    // Going back it sticks until the other rim of the static circle.
    for (double back = x; back > held - 0.6 * kPressure_m + kStep_m; back -= kStep_m) {
      const TextbookRest rest = at(back);
      if (back < x - kStep_m) {
        ASSERT_EQ(rest.friction, FrictionState::stick) << back;
      }
      ASSERT_NEAR(rest.proxy.x(), held, 1e-8);
    }
    EXPECT_EQ(at(held - 0.6 * kPressure_m - kStep_m).friction, FrictionState::slip);
    EXPECT_EQ(course.move({x, 0.01, 0.0013}).friction, FrictionState::free);
  }
}

TEST(TextbookProxy, KeepsItsPlaceForAToolThatIsNotInTheWorldAndForASearchThatIsCut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const TextbookRule rule : kAllRules) {
    TextbookCourse course(textbook_plate(), Sides::one, rule, kPushOut_m, kRough,
                          {0.0, 0.001, 0.0013});
    const Vec3 tool(0.0, -0.001, 0.0013);
    course.move(tool);
    const Vec3 held = course.move(tool).proxy;
    for (const Vec3& invalid : {Vec3(0.0, kNan, 0.0), Vec3(2.0 * kWorldBound_m, 0.0, 0.0)}) {
      const TextbookRest rest = course.move(invalid);
      EXPECT_EQ(rest.flags, kTouchToolInvalid);
      EXPECT_EQ(rest.proxy, held);
      EXPECT_EQ(rest.planes, 0);
    }
    const TextbookRest cut = course.move({0.001, -0.001, 0.0013}, 1);
    EXPECT_EQ(cut.flags, kTouchIterationsExhausted);
    EXPECT_EQ(cut.proxy, held);
    EXPECT_EQ(cut.visited, 1U);
    EXPECT_GT(course.move(tool).planes, 0);
  }
}

}  // namespace
}  // namespace tactus::rendering
