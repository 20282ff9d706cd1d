#include "rendering/scene/hierarchy_check.h"

#include <gtest/gtest.h>

#include <vector>

#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Triangles that are all the same one, under nodes of the caller's making.
struct Forest {
  std::vector<Float3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  std::vector<TriangleIndices> triangles;
  std::vector<BvhNode> nodes;

  explicit Forest(std::size_t triangle_count) : triangles(triangle_count, {0, 1, 2}) {}

  void inner(std::uint32_t left) { nodes.push_back({{0, 0, 0}, left, {1, 1, 0}, 0}); }
  void leaf(std::uint32_t first, std::uint32_t count) {
    nodes.push_back({{0, 0, 0}, first, {1, 1, 0}, count});
  }
  [[nodiscard]] std::expected<void, SceneError> check() const {
    return check_hierarchy({.vertices = vertices, .triangles = triangles, .nodes = nodes});
  }
};

void expect_fault(const Forest& forest, SceneFault fault) {
  const auto result = forest.check();
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().fault, fault);
}

// A chain: every left child a leaf, every right child the next level, the last one a leaf.
Forest chain(std::uint32_t levels) {
  Forest forest(levels);
  forest.inner(1);
  for (std::uint32_t level = 2; level < levels; ++level) {
    forest.leaf(level - 2, 1);
    forest.inner(2 * level - 1);
  }
  forest.leaf(levels - 2, 1);
  forest.leaf(levels - 1, 1);
  return forest;
}

TEST(HierarchyCheck, AcceptsTwoLevels) {
  Forest forest(3);
  forest.inner(1);
  forest.leaf(0, 2);
  forest.leaf(2, 1);
  EXPECT_TRUE(forest.check().has_value());
}

TEST(HierarchyCheck, AcceptsTheDeepestHierarchyAndNoDeeper) {
  EXPECT_TRUE(chain(kMaxHierarchyDepth).check().has_value());
  expect_fault(chain(kMaxHierarchyDepth + 1), SceneFault::hierarchy_depth);
}

TEST(HierarchyCheck, RefusesACycle) {
  Forest forest(2);
  forest.inner(0);
  forest.leaf(0, 2);
  expect_fault(forest, SceneFault::hierarchy_child);
}

TEST(HierarchyCheck, RefusesAChildThatIsMissing) {
  Forest forest(2);
  forest.inner(2);
  forest.leaf(0, 1);
  forest.leaf(1, 1);
  expect_fault(forest, SceneFault::hierarchy_child);
  forest.nodes[0].first = 0xffffffff;
  expect_fault(forest, SceneFault::hierarchy_child);
}

TEST(HierarchyCheck, RefusesALoneInnerNode) {
  Forest forest(1);
  forest.inner(1);
  expect_fault(forest, SceneFault::hierarchy_child);
}

TEST(HierarchyCheck, RefusesLeavesThatOverlapLeaveGapsOrSwapOrder) {
  for (const auto& [a, b] : {std::pair{std::pair{0U, 2U}, std::pair{1U, 2U}},
                             std::pair{std::pair{0U, 1U}, std::pair{2U, 1U}},
                             std::pair{std::pair{1U, 2U}, std::pair{0U, 1U}},
                             std::pair{std::pair{0U, 1U}, std::pair{1U, 1U}}}) {
    Forest forest(3);
    forest.inner(1);
    forest.leaf(a.first, a.second);
    forest.leaf(b.first, b.second);
    expect_fault(forest, SceneFault::hierarchy_cover);
  }
}

TEST(HierarchyCheck, RefusesANodeThatNothingLeadsTo) {
  Forest forest(1);
  forest.leaf(0, 1);
  forest.leaf(0, 1);
  expect_fault(forest, SceneFault::hierarchy_cover);
}

// Every level names the same pair twice: 2^60 paths, which a check without this in mind would walk.
TEST(HierarchyCheck, RefusesSharedChildrenWithoutWalkingEveryPath) {
  Forest forest(2);
  forest.inner(1);
  for (std::uint32_t level = 1; level < 60; ++level) {
    forest.inner(2 * level + 1);
    forest.inner(2 * level + 1);
  }
  forest.leaf(0, 1);
  forest.leaf(1, 1);
  expect_fault(forest, SceneFault::hierarchy_cover);
}

TEST(HierarchyCheck, RefusesAChildBoxThatSticksOut) {
  Forest forest(2);
  forest.inner(1);
  forest.leaf(0, 1);
  forest.leaf(1, 1);
  forest.nodes[2].upper.z = 0.1F;
  expect_fault(forest, SceneFault::hierarchy_box);
}

}  // namespace
}  // namespace tactus::rendering
