#include "rendering/geometry/hierarchy_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "tests/support/shapes.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Solid;

class HierarchyWalkTest : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeed = 22;

  [[nodiscard]] std::span<const BvhNode> nodes() const { return solid_.object().mesh.nodes; }

  // Returns the leaves near a box by looking at every node.
  [[nodiscard]] std::vector<std::uint32_t> near_leaves(const NearBox& box) const {
    std::vector<std::uint32_t> found;
    for (const BvhNode& node : nodes()) {
      if (node.is_leaf() && box.near(node)) {
        found.push_back(node.first);
      }
    }
    std::ranges::sort(found);
    return found;
  }

  NearBox any_box() {
    const Vec3 p = Vec3(unit(), unit(), unit()) * 0.24 - Vec3::Constant(0.12);
    return {p, 0.01 * Vec3(unit(), unit(), unit()), 0.1 * unit() * unit()};
  }
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  Solid solid_{testing::icosphere(0.1, 4), Sides::one, Material{.stiffness_N_per_m = 1000.0}};
  std::mt19937_64 random_{kSeed};
};

// Leaves, as many a visit as it may.
struct Collector {
  std::vector<std::uint32_t> found;
  std::size_t room = 0;

  void leaf(const BvhNode& leaf) {
    found.push_back(leaf.first);
    --room;
  }
  [[nodiscard]] bool exhausted() const { return room == 0; }
};

TEST_F(HierarchyWalkTest, FindsEveryLeafThatIsNearOnceHoweverOftenItIsLeft) {
  std::size_t most = 0;
  for (int k = 0; k < 2'000; ++k) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(k));
    const NearBox box = any_box();
    Collector collector;
    WalkLeft left;
    begin_walk(nodes(), box, left);
    while (left.count() > 0) {
      collector.room = 1 + static_cast<std::size_t>(60.0 * unit());
      go_on_walking(nodes(), box, left, collector);
      ASSERT_LE(left.count(), WalkLeft::kMostLeft);
    }
    std::ranges::sort(collector.found);
    EXPECT_EQ(collector.found, near_leaves(box));
    most = std::max(most, collector.found.size());
  }
  EXPECT_GT(most, 500U) << "more than wait in a queue";
}

TEST_F(HierarchyWalkTest, ThatBeginsWithAllThatOneCanLeaveHasRoom) {
  const NearBox everything(Vec3::Zero(), Vec3::Ones(), 1.0);
  Collector collector;
  WalkLeft left;
  while (left.count() < WalkLeft::kMostLeft) {
    left.add(0);
  }
  collector.room = static_cast<std::size_t>(-1);
  go_on_walking(nodes(), everything, left, collector);
  EXPECT_EQ(collector.found.size(), WalkLeft::kMostLeft * near_leaves(everything).size());
}

TEST_F(HierarchyWalkTest, OfOneLeafIsThatLeaf) {
  const std::array<BvhNode, 1> alone{
      BvhNode{.lower = {}, .upper = {1.0F, 1.0F, 1.0F}, .triangle_count = 2}};
  Collector collector{.found = {}, .room = 10};
  WalkLeft left;
  begin_walk(alone, NearBox(Vec3::Ones(), Vec3::Zero(), 0.1), left);
  go_on_walking(alone, NearBox(Vec3::Ones(), Vec3::Zero(), 0.1), left, collector);
  EXPECT_EQ(collector.found.size(), 1U);
  begin_walk(alone, NearBox(2.0 * Vec3::Ones(), Vec3::Zero(), 0.1), left);
  EXPECT_EQ(left.count(), 0U);
}

}  // namespace
}  // namespace tactus::rendering
