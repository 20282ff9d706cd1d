#include "rendering/geometry/near_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/unit/rendering/geometry/any_boxes.h"

namespace tactus::rendering {
namespace {

class NearBoxTest : public ::testing::Test, protected testing::AnyBoxes {
 protected:
  NearBoxTest() : AnyBoxes(kSeed) {}

  static constexpr std::uint64_t kSeed = 11;
};

double distance_to_box(const Vec3& p, const Vec3& lower, const Vec3& upper) {
  return (p - p.cwiseMax(lower).cwiseMin(upper)).norm();
}

TEST_F(NearBoxTest, ThoseThatComeNearAreNeverMissedInFloats) {
  for (int k = 0; k < 100'000; ++k) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(k));
    const double scale = std::pow(10.0, 4.0 * unit() - 3.0);
    const Vec3 corner = scale * vector();
    const BvhNode node = box_at(corner);
    const Vec3 half = 0.001 * (Vec3::Ones() + vector());
    const Vec3 p = corner + 0.02 * vector();
    const Vec3 lower = to_vec3(node.lower) - half;
    const Vec3 upper = to_vec3(node.upper) + half;
    const double distance = distance_to_box(p, lower, upper);
    EXPECT_TRUE(NearBox(p, half, distance).near(node));
    EXPECT_FALSE(NearBox(p, half, 0.5 * distance - 1e-4 * scale - 1e-5).near(node) &&
                 distance > 4e-4 * scale + 4e-5);
  }
}

TEST_F(NearBoxTest, TwoAskedAtOnceAnswerAsEachAlone) {
  int near_ones = 0;
  for (int k = 0; k < 10'000; ++k) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(k));
    const BvhNode first = box_at(0.02 * vector());
    const BvhNode second = box_at(0.02 * vector());
    const NearBox box(0.02 * vector(), 0.001 * (Vec3::Ones() + vector()), 0.01 * unit());
    const NearBox::Pair both = box.near(first, second);
    EXPECT_EQ(both.first != 0, box.near(first));
    EXPECT_EQ(both.second != 0, box.near(second));
    near_ones += box.near(first) ? 1 : 0;
  }
  EXPECT_GT(near_ones, 500);
  EXPECT_LT(near_ones, 9'000);
}

}  // namespace
}  // namespace tactus::rendering
