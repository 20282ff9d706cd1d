#include "rendering/geometry/box_entry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tests/unit/rendering/geometry/any_boxes.h"

namespace tactus::rendering {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

class BoxEntryTest : public ::testing::Test, protected testing::AnyBoxes {
 protected:
  BoxEntryTest() : AnyBoxes(kSeed) {}

  static constexpr std::uint64_t kSeed = 21;

  // Some rays run along an axis.
  Vec3 direction() {
    Vec3 motion = vector();
    for (int k = 0; k < 2; ++k) {
      motion[static_cast<int>(3.0 * unit())] *= unit() < 0.2 ? 0.0 : 1.0;
    }
    return motion.squaredNorm() > 0.0 ? motion.normalized() : Vec3{Vec3::UnitZ()};
  }
};

// Axis by axis, in double.
double entry_of(const BvhNode& box, const Vec3& from, const Vec3& direction, double margin) {
  double enter = 0.0;
  double leave = kNever;
  for (int k = 0; k < 3; ++k) {
    const double lower = to_vec3(box.lower)[k] - margin - from[k];
    const double upper = to_vec3(box.upper)[k] + margin - from[k];
    if (direction[k] == 0.0) {
      leave = lower <= 0.0 && upper >= 0.0 ? leave : -1.0;
      continue;
    }
    enter = std::max(enter, std::min(lower / direction[k], upper / direction[k]));
    leave = std::min(leave, std::max(lower / direction[k], upper / direction[k]));
  }
  return enter <= leave ? enter : kNever;
}

TEST_F(BoxEntryTest, IsNeverLateAndHardlyEarly) {
  int entered = 0;
  for (int k = 0; k < 200'000; ++k) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(k));
    const double scale = std::pow(10.0, 4.0 * unit() - 3.0);
    const Vec3 from = scale * vector();
    const BvhNode box = box_at(from + 0.03 * vector());
    const Vec3 along = direction();
    const double margin = 0.005 * unit();
    const double exact = entry_of(box, from, along, margin);
    const auto [first, second] = BoxEntry(from, along, margin).into(box, box, 1.0);
    EXPECT_EQ(first, second);
    EXPECT_LE(static_cast<double>(first), exact);
    if (exact > 1.0) {
      continue;
    }
    ++entered;
    // The box grows by this for rounding; along a slanted path that is more.
    const double grown = 1e-6 * (scale + 1.0);
    EXPECT_GE(static_cast<double>(first),
              entry_of(box, from, along, margin + grown) - 1e-6 * (exact + scale));
  }
  EXPECT_GT(entered, 10'000);
}

TEST_F(BoxEntryTest, TwoAskedAtOnceAnswerAsEachAlone) {
  for (int k = 0; k < 10'000; ++k) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(k));
    const BvhNode first = box_at(0.02 * vector());
    const BvhNode second = box_at(0.02 * vector());
    const BoxEntry entry(0.02 * vector(), direction(), 0.002 * unit());
    const BoxEntry::Pair both = entry.into(first, second, 0.05);
    EXPECT_EQ(both.first, entry.into(first, first, 0.05).first);
    EXPECT_EQ(both.second, entry.into(second, second, 0.05).first);
  }
}

TEST_F(BoxEntryTest, BeyondTheLimitIsNever) {
  const BvhNode box{.lower = {1.0F, -1.0F, -1.0F}, .upper = {2.0F, 1.0F, 1.0F}};
  const BoxEntry entry(Vec3::Zero(), Vec3::UnitX(), 0.1);
  EXPECT_TRUE(std::isinf(entry.into(box, box, 0.89).first));
  EXPECT_NEAR(entry.into(box, box, 0.91).first, 0.9F, 1e-5F);
}

}  // namespace
}  // namespace tactus::rendering
