#include "rendering/contact/tangent_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "tests/support/brute_force.h"

namespace tactus::rendering {
namespace {

Vec3 point_about_zero(std::mt19937_64& random, double size_m) {
  std::uniform_real_distribution<double> along(-size_m, size_m);
  return {along(random), along(random), along(random)};
}

// Random triangles about a point that is far from the world's origin.
class TangentBoundsTest : public ::testing::Test {
 protected:
  static constexpr double kReach_m = 0.002;
  static constexpr std::size_t kTriangles = 203;  // no multiple of four

  TangentBoundsTest() {
    RecordProperty("seed", kSeed);
    for (std::size_t i = 0; i < kTriangles; ++i) {
      const Vec3 middle = origin_ + point_about_zero(random_, 0.006);
      triangles_.emplace_back(middle + point_about_zero(random_, 0.002),
                              middle + point_about_zero(random_, 0.002),
                              middle + point_about_zero(random_, 0.002));
    }
    bounds_->start(origin_, kReach_m);
    for (std::size_t i = 0; i < kTriangles; ++i) {
      bounds_->set_tangent(i, triangles_[i].nearest(origin_), origin_, 0.0);
    }
    bounds_->fill_last_four(kTriangles);
  }

  static constexpr int kSeed = 20261125;
  std::mt19937_64 random_{kSeed};
  const Vec3 origin_{1.0, -2.0, 3.0};
  std::vector<Triangle> triangles_;
  std::unique_ptr<TangentBounds> bounds_ = std::make_unique<TangentBounds>();
  CandidateNumbers found_;
};

TEST_F(TangentBoundsTest, FindEveryTriangleThatIsWithinReachAndNoneThatIsFar) {
  std::size_t far = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 p = origin_ + point_about_zero(random_, 0.004);
    bounds_->find(kTriangles, p, 0.0, found_);
    ASSERT_TRUE(std::ranges::is_sorted(found_.all()));
    for (std::uint16_t i = 0; i < kTriangles; ++i) {
      const bool is_found = std::ranges::binary_search(found_.all(), i);
      ASSERT_EQ(is_found, bounds_->may_reach(i, bounds_->at(p)));
      if (triangles_[i].nearest(p).distance <= kReach_m) {
        ASSERT_TRUE(is_found) << "triangle " << i << ", trial " << trial;
      }
      far += is_found ? 0U : 1U;
    }
  }
  EXPECT_GT(far, 300 * kTriangles / 3);
}

TEST_F(TangentBoundsTest, OfAShorterReachAreOutOfReachSooner) {
  const Nearest nearest = triangles_[0].nearest(origin_);
  const double shorter_m = kReach_m - 0.5 * nearest.distance;
  bounds_->set_tangent(0, nearest, origin_, shorter_m);
  EXPECT_FALSE(bounds_->may_reach(0, bounds_->at(origin_)));
  bounds_->set_tangent(0, nearest, origin_, shorter_m - nearest.distance);
  EXPECT_TRUE(bounds_->may_reach(0, bounds_->at(origin_)));
}

TEST_F(TangentBoundsTest, NoneIsWithinReachOfEveryPlace) {
  bounds_->set_none(5);
  for (int trial = 0; trial < 20; ++trial) {
    EXPECT_TRUE(bounds_->may_reach(5, bounds_->at(origin_ + point_about_zero(random_, 1.0))));
  }
}

TEST_F(TangentBoundsTest, AMarginFindsMore) {
  bounds_->find(kTriangles, origin_, 0.0, found_);
  const std::size_t few = found_.count;
  bounds_->find(kTriangles, origin_, 0.004, found_);
  EXPECT_GT(found_.count, few);
}

}  // namespace
}  // namespace tactus::rendering
