// The textbook's god-objects against closed forms of where the lecture's rules put them, with their
// faults.
#include "rendering/contact/textbook/textbook_proxy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/connected_solid.h"
#include "tests/support/materials.h"
#include "tests/unit/rendering/contact/textbook/textbook_course.h"

namespace tactus::rendering {
namespace {

using testing::kFloatRounding_m;
using testing::kPushOut_m;
using testing::kSlippery;
using testing::textbook_plate;
using testing::TextbookCourse;

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
    TextbookCourse course(textbook_plate(), Sides::one, rule, kPushOut_m, kSlippery,
                          {0.0, 0.01, 0.0013});
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
  TextbookCourse course(textbook_plate(), Sides::one, TextbookRule::one_step, kPushOut_m, kSlippery,
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

}  // namespace
}  // namespace tactus::rendering
