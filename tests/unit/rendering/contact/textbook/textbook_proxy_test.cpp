// The textbook's god-objects against closed forms of where the lecture's rules put them, with their
// faults.
#include "rendering/contact/textbook/textbook_proxy.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "rendering/limits.h"
#include "tests/support/connected_solid.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/contact/textbook/textbook_course.h"

namespace tactus::rendering {
namespace {

using testing::kRough;
using testing::kSlippery;
using testing::Shape;
using testing::share_of;
using testing::TextbookCourse;

constexpr double kPushOut_m = 1e-6;
// Vertices are floats: planes of some centimetres are as exact as this.
constexpr double kFloatRounding_m = 5e-9;
constexpr std::array kAllRules{TextbookRule::one_plane, TextbookRule::three_sub_goals,
                               TextbookRule::three_step, TextbookRule::one_step};

// A plate with its front at y = 0 exactly.
Shape plate() {
  constexpr double kThickness_m = 0.03125;
  return testing::moved(testing::box({0.2, kThickness_m, 0.1}), {0.0, -0.5 * kThickness_m, 0.0});
}

// A V groove along z whose deepest line is at y = -kGrooveDepth_m.
constexpr double kGrooveDepth_m = 0.02;

// The tool's places in a groove of the given angle: free, in the left wall, and below the deepest
// line, where both walls hold it.
struct GroovePath {
  explicit GroovePath(double angle_deg) {
    const double half = 0.5 * angle_deg * std::numbers::pi / 180.0;
    left = {std::cos(half), std::sin(half), 0.0};
    right = {-std::cos(half), std::sin(half), 0.0};
    const Vec3 middle(-0.5 * kGrooveDepth_m * std::tan(half), -0.5 * kGrooveDepth_m, 0.0013);
    free = middle + 0.004 * left;
    in_left = middle - 0.004 * left;
    below = {-0.003, -kGrooveDepth_m - 0.010, 0.0013};
    // The point of the line where the raised planes meet, beside the tool.
    meeting = {0.0, -kGrooveDepth_m + kPushOut_m / std::sin(half), 0.0013};
  }
  Vec3 left, right, free, in_left, below, meeting;
};

TextbookCourse groove(double angle_deg, TextbookRule rule, const GroovePath& path) {
  return {testing::grooved_block(angle_deg, kGrooveDepth_m),
          Sides::one,
          rule,
          kPushOut_m,
          kSlippery,
          path.free};
}

TEST(TextbookProxy, IsTheProjectionOnAFlatPlateByEveryRuleButOneStep) {
  for (const TextbookRule rule :
       {TextbookRule::one_plane, TextbookRule::three_sub_goals, TextbookRule::three_step}) {
    TextbookCourse course(plate(), Sides::one, rule, kPushOut_m, kSlippery, {0.0, 0.01, 0.0013});
    for (int k = 0; k < 200; ++k) {
      const Vec3 tool(1e-4 * k, 0.00995 - 1e-4 * k, 0.0013 + 1e-5 * k);
      const TextbookRest rest = course.move(tool);
      const bool is_inside = tool.y() <= 0.0;
      ASSERT_EQ(rest.planes, is_inside ? 1 : 0) << k;
      const Vec3 expected = is_inside ? Vec3{tool.x(), kPushOut_m, tool.z()} : tool;
      EXPECT_LT((rest.proxy - expected).norm(), 1e-15) << k;
      EXPECT_NEAR(rest.depth_m, is_inside ? kPushOut_m - tool.y() : 0.0, 1e-15);
      EXPECT_EQ(rest.friction, FrictionState::free);
      EXPECT_EQ(rest.flags, kTouchClean);
    }
  }
}

TEST(TextbookProxy, OnePlaneIsInTheAirForATickAtEachConvexEdge) {
  constexpr int kSides = 8;
  constexpr double kCircumradius_m = 0.02;
  constexpr double kToolRadius_m = 0.0165;
  constexpr int kTextbookTicks = 1001;
  const double sector = 2.0 * std::numbers::pi / kSides;
  const double apothem = kCircumradius_m * std::cos(0.5 * sector);
  const double half_side = kCircumradius_m * std::sin(0.5 * sector);
  TextbookCourse course(testing::prism(kSides, kCircumradius_m, 0.04), Sides::one,
                        TextbookRule::one_plane, kPushOut_m, kSlippery, {0.03, 0.0124, 0.0013});
  int off_surface = 0;
  int face = 0;
  for (int k = 0; k < kTextbookTicks; ++k) {
    const double angle = 0.5 * sector + 0.002 + 2.0 * std::numbers::pi * k / kTextbookTicks;
    const Vec3 tool(kToolRadius_m * std::cos(angle), kToolRadius_m * std::sin(angle), 0.0013);
    const TextbookRest rest = course.move(tool);
    const double middle = sector * (face + 0.5);
    const Vec3 normal(std::cos(middle), std::sin(middle), 0.0);
    const Vec3 along(-std::sin(middle), std::cos(middle), 0.0);
    const double place = tool.dot(along);
    EXPECT_LT((rest.normal - normal).norm(), 1e-6) << k;
    EXPECT_LT(
        (rest.proxy - ((apothem + kPushOut_m) * normal + place * along + tool.z() * Vec3::UnitZ()))
            .norm(),
        2.0 * kFloatRounding_m)
        << k;
    const double overshoot = place - half_side;
    if (overshoot > 0.0) {
      // The projected goal is beyond the edge: over the next face by the sine of their angle.
      EXPECT_NEAR(course.distance(rest.proxy),
                  overshoot * std::sin(sector) + kPushOut_m * std::cos(sector), kFloatRounding_m)
          << k;
      ++off_surface;
      ++face;
    } else {
      EXPECT_NEAR(course.distance(rest.proxy), kPushOut_m, kFloatRounding_m) << k;
    }
  }
  EXPECT_EQ(off_surface, kSides);
}

TEST(TextbookProxy, OnePlaneCrossesTheOtherFaceOfAGrooveAndIsFreeATickLater) {
  for (const double angle_deg : {60.0, 90.0, 120.0}) {
    SCOPED_TRACE(angle_deg);
    const GroovePath path(angle_deg);
    TextbookCourse course = groove(angle_deg, TextbookRule::one_plane, path);
    const TextbookRest in_left = course.move(path.in_left);
    EXPECT_NEAR(course.distance(in_left.proxy), kPushOut_m, kFloatRounding_m);
    const TextbookRest crossed = course.move(path.below);
    // The projection on the left wall's plane alone.
    const Vec3 bottom(0.0, -kGrooveDepth_m, 0.0);
    const Vec3 projected =
        path.below + (kPushOut_m - path.left.dot(path.below - bottom)) * path.left;
    EXPECT_LT((crossed.proxy - projected).norm(), 2.0 * kFloatRounding_m);
    EXPECT_EQ(crossed.planes, 1);
    EXPECT_LT(path.right.dot(crossed.proxy - bottom), -1e-3) << "behind the right wall";
    EXPECT_NEAR(testing::winding_number(course.shape(), crossed.proxy), 1.0, 1e-6);
    const TextbookRest later = course.move(path.below);
    EXPECT_EQ(later.planes, 0);
    EXPECT_EQ(later.proxy, path.below);
  }
}

TEST(TextbookProxy, ThreeSubGoalsStayWhereBothFacesOfAGrooveMeet) {
  for (const double angle_deg : {30.0, 60.0, 90.0, 120.0}) {
    SCOPED_TRACE(angle_deg);
    const GroovePath path(angle_deg);
    TextbookCourse course = groove(angle_deg, TextbookRule::three_sub_goals, path);
    course.move(path.in_left);
    for (int tick = 0; tick < 20; ++tick) {
      const TextbookRest rest = course.move(path.below);
      EXPECT_EQ(rest.planes, 2);
      EXPECT_LT((rest.proxy - path.meeting).norm(), 4.0 * kFloatRounding_m) << tick;
      EXPECT_NEAR(course.distance(rest.proxy), kPushOut_m, kFloatRounding_m);
    }
    const TextbookRest free = course.move(path.free);
    EXPECT_EQ(free.planes, 0);
    EXPECT_EQ(free.proxy, path.free);
  }
}

TEST(TextbookProxy, ThreeStepReachesTheLineOfTwoPerpendicularFaces) {
  const GroovePath path(90.0);
  TextbookCourse course = groove(90.0, TextbookRule::three_step, path);
  course.move(path.in_left);
  for (int tick = 0; tick < 20; ++tick) {
    const TextbookRest rest = course.move(path.below);
    EXPECT_EQ(rest.planes, 2);
    EXPECT_EQ(rest.segments, 3);
    EXPECT_LT((rest.proxy - path.meeting).norm(), 4.0 * kFloatRounding_m) << tick;
  }
}

TEST(TextbookProxy, ThreeStepIsStoppedAgainByTheFirstFaceOfAnAcuteGroove) {
  for (const double angle_deg : {45.0, 60.0, 75.0}) {
    SCOPED_TRACE(angle_deg);
    const GroovePath path(angle_deg);
    TextbookCourse course = groove(angle_deg, TextbookRule::three_step, path);
    course.move(path.in_left);
    const TextbookRest rest = course.move(path.below);
    EXPECT_EQ(rest.planes, 3);
    EXPECT_NEAR(path.left.dot(rest.proxy - Vec3(0.0, -kGrooveDepth_m, 0.0)), kPushOut_m,
                kFloatRounding_m);
    EXPECT_NEAR(testing::winding_number(course.shape(), rest.proxy), 0.0, 1e-6);
  }
}

// The push-out from one wall crosses the other one where the groove is narrower than it, and in an
// acute groove the god-object comes there, however small the push-out is.
TEST(TextbookProxy, ThreeStepAndOneStepArePushedOutThroughTheOtherFaceOfAnAcuteGroove) {
  for (const TextbookRule rule : {TextbookRule::three_step, TextbookRule::one_step}) {
    for (const double angle_deg : {45.0, 60.0, 75.0, 90.0, 120.0}) {
      for (const double push_out_m : {1e-6, 1e-4}) {
        SCOPED_TRACE(angle_deg);
        const GroovePath path(angle_deg);
        TextbookCourse course(testing::grooved_block(angle_deg, kGrooveDepth_m), Sides::one, rule,
                              push_out_m, kSlippery, path.free);
        course.move(path.in_left);
        bool is_inside = false;
        for (int tick = 0; tick < 100 && !is_inside; ++tick) {
          is_inside = testing::winding_number(course.shape(), course.move(path.below).proxy) > 0.5;
        }
        EXPECT_EQ(is_inside, angle_deg <= 60.0);
      }
    }
  }
}

TEST(TextbookProxy, OneStepSwingsFromTickToTickByTheTravelOfATick) {
  constexpr double kTravel_m = 1e-4;
  constexpr double kDepth_m = 1e-3;
  TextbookCourse course(plate(), Sides::one, TextbookRule::one_step, kPushOut_m, kSlippery,
                        {-0.05, kPushOut_m, 0.0013});
  const double share = kPushOut_m / (kPushOut_m + kDepth_m);
  Vec3 last = Vec3::Zero();
  for (int k = 1; k <= 400; ++k) {
    const Vec3 tool(-0.05 + kTravel_m * k, -kDepth_m, 0.0013);
    const TextbookRest rest = course.move(tool);
    ASSERT_EQ(rest.planes, 1);
    ASSERT_EQ(rest.segments, 1);
    EXPECT_NEAR(rest.proxy.y(), kPushOut_m, 1e-15);
    EXPECT_NEAR(rest.depth_m, kDepth_m + kPushOut_m, 1e-15);
    // A tick that finds the plate stays behind; the next one follows the tool.
    const double lag = k % 2 == 1 ? kTravel_m * (1.0 - share) : 0.0;
    EXPECT_NEAR(tool.x() - rest.proxy.x(), lag, 1e-15) << k;
    const Vec3 stretch = rest.proxy - tool;
    if (k > 1) {
      EXPECT_NEAR((stretch - last).norm(), kTravel_m, 0.01 * kTravel_m);
    }
    last = stretch;
  }
}

TEST(TextbookProxy, FallsThroughByRoundingWithoutAPushOut) {
  // Pressed and slid along a plate whose normal has no axis of the frame.
  const Vec3 axis(1.0, 2.0, 3.0);
  const Shape tilted = testing::turned(plate(), axis, 0.7);
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
    TextbookCourse course(plate(), Sides::one, rule, kPushOut_m, kRough, {0.0, 0.001, 0.0013});
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
    // On the way back it sticks until the other rim of the static circle.
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
    TextbookCourse course(plate(), Sides::one, rule, kPushOut_m, kRough, {0.0, 0.001, 0.0013});
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
