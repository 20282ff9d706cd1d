// The proxy comes to rest on the mouth of a notch. The oracle is every triangle's nearest point.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "rendering/world/world.h"
#include "tests/support/brute_force.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Corners;
using testing::kMicron;
using testing::Solid;

// A notch of two degrees in the flat end of a block. Near its bottom it is so narrow that the
// sphere over it hardly comes lower than on the end itself, and the tool is so deep in the block
// that a move down on one edge ends far beyond the other.
class NotchTest : public ::testing::TestWithParam<double> {
 protected:
  static constexpr double kLength_m = 0.03;
  static constexpr double kEnd_m = 0.03;  // where the end is, along z
  static constexpr int kJumps = 10'000;

  NotchTest() : block_(testing::grooved_block(2, kLength_m), Sides::one, testing::kSlippery) {}

  Vec3 somewhere_below() {
    return {between(-0.4e-3, 0.4e-3), between(0.0002, 0.008) - kLength_m, between(-0.03, 0.0)};
  }
  double between(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
  }
  Touch jump(const Vec3& from, const Vec3& to) {
    world_->reset();
    world_->touch({.p_W = {from.x(), from.y(), kEnd_m + 0.01}});
    world_->touch({.p_W = from});
    return world_->touch({.p_W = to});
  }
  Solid block_;
  std::vector<Corners> triangles_ = testing::corners_of(block_.shape());
  std::unique_ptr<World> world_ = std::make_unique<World>();
  std::mt19937_64 random_{1};
};

TEST_P(NotchTest, IsNotHeldByASideThatItHasLeft) {
  ASSERT_TRUE(world_->set_scene({&block_.object(), 1}, {.tool_radius_m = GetParam()}));
  int cut_short = 0;
  for (int k = 0; k < std::max(1'000, testing::part_of(kJumps)); ++k) {
    const Vec3 from = somewhere_below();
    Vec3 to = somewhere_below();
    if (k % 2 != 0) {
      to.y() = from.y() + between(-1e-4, 1e-4);  // across
    }
    const Touch t = jump(from, to);
    if (t.flags != kTouchClean) {
      ++cut_short;
      continue;
    }
    ASSERT_LE(testing::descent_left(t.proxy_W, to, triangles_, GetParam() + kMicron), kMicron)
        << "jump " << k << " from " << from.transpose() << " to " << to.transpose();
  }
  EXPECT_LE(cut_short, kJumps / 1000);
}

INSTANTIATE_TEST_SUITE_P(Radii, NotchTest, ::testing::Values(0.001, 0.004));

}  // namespace
}  // namespace tactus::rendering
