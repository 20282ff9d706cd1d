#include "rendering/geometry/straight_way.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

class Boxes : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeed = 11;

  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  Vec3 vector() { return {2.0 * unit() - 1.0, 2.0 * unit() - 1.0, 2.0 * unit() - 1.0}; }

  std::mt19937_64 random_{kSeed};
};

double distance_to_box(const Vec3& p, const Vec3& lower, const Vec3& upper) {
  return (p - p.cwiseMax(lower).cwiseMin(upper)).norm();
}

TEST_F(Boxes, OnlyThoseFartherThanTheReachFromAllOfTheWayAreCleared) {
  int cleared = 0;
  for (int k = 0; k < 20'000; ++k) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(k));
    const Vec3 along = k % 10 == 0 ? Vec3{Vec3::Zero()} : vector();
    const StraightWay way(along);
    const Vec3 lower = 2.0 * vector();
    const Vec3 upper = lower + 0.3 * (Vec3::Ones() + vector());
    const double reach = 0.5 * unit();
    double nearest = 1e9;
    for (int i = 0; i <= 200; ++i) {
      nearest = std::min(nearest, distance_to_box(i / 200.0 * along, lower, upper));
    }
    if (way.clears(way.gap(lower, upper), reach)) {
      ++cleared;
      EXPECT_GE(nearest, reach - 1e-12);
    } else {
      EXPECT_LT(nearest, reach + 0.7) << "it should see that from here";
    }
  }
  EXPECT_GT(cleared, 10'000);
}

TEST_F(Boxes, ThatComeNearAreNeverMissedInFloats) {
  for (int k = 0; k < 100'000; ++k) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(k));
    const double scale = std::pow(10.0, 4.0 * unit() - 3.0);
    const auto stored = [](const Vec3& v) {
      return Float3{static_cast<float>(v.x()), static_cast<float>(v.y()),
                    static_cast<float>(v.z())};
    };
    const Vec3 corner = scale * vector();
    const BvhNode node{.lower = stored(corner),
                       .first = 0xffff'ffffU,
                       .upper = stored(corner + 0.01 * (Vec3::Ones() + vector())),
                       .triangle_count = 0x7fc0'0000U};
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

}  // namespace
}  // namespace tactus::rendering
