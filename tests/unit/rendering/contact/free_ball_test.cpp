#include "rendering/contact/free_ball.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>

#include "tests/support/brute_force.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Solid;

class FreeBallTest : public ::testing::Test {
 protected:
  static constexpr double kBall_m = 0.03;

  FreeBallTest() { EXPECT_TRUE(scene_->set({&solid_.object(), 1})); }
  // Beyond the tool's reach, asked of every triangle.
  double clearance(const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const testing::Corners& corners : corners_) {
      least = std::min(least, (testing::nearest_point(corners, p) - p).norm());
    }
    return least - margins_.sphere.reach_m;
  }
  // Returns a point in a cube about the ball, outside or inside of it.
  Vec3 somewhere() {
    std::uniform_real_distribution<double> side(-2.0 * kBall_m, 2.0 * kBall_m);
    return {side(random_), side(random_), side(random_)};
  }

  // Returns the number of places to look at, fewer where a sanitizer makes it slow.
  static int places() { return std::max(200, testing::part_of(2000)); }

  Solid solid_{testing::icosphere(kBall_m, 3), Sides::two, testing::kSlippery};
  std::vector<testing::Corners> corners_ = testing::corners_of(solid_.shape());
  std::unique_ptr<SceneObjects> scene_ = std::make_unique<SceneObjects>();
  ContactMargins margins_{0.002};
  std::mt19937_64 random_{20261122};
};

TEST_F(FreeBallTest, NothingIsNearerAndWhereItIsAskedForItIsOftenFound) {
  constexpr double kWanted_m = 1e-3;
  int found = 0;
  for (int k = 0; k < places(); ++k) {
    const Vec3 p = somewhere();
    TickBudget budget;
    const double radius = free_radius(*scene_, margins_, p, kWanted_m, budget);
    if (radius >= kWanted_m) {
      ASSERT_LE(radius, clearance(p) + 1e-9) << p.transpose();
      ++found;
    }
  }
  EXPECT_GT(found, places() / 2);
}

TEST_F(FreeBallTest, WhereThereIsNotAsMuchAsIsAskedForItSaysLess) {
  for (int k = 0; k < places(); ++k) {
    const Vec3 p = somewhere();
    TickBudget budget;
    const double least = std::max(0.0, clearance(p)) + 1e-6;
    ASSERT_LT(free_radius(*scene_, margins_, p, least, budget), least) << p.transpose();
  }
}

}  // namespace
}  // namespace tactus::rendering
