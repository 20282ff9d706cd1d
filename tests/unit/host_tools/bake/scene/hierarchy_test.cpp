// The quality of the hierarchy: how many triangles a query near a surface looks at.
#include "host_tools/mesh/hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

#include "tests/support/shapes.h"
#include "tests/support/share.h"

namespace tactus::host {
namespace {

using rendering::BvhNode;
using rendering::Float3;
using rendering::TriangleIndices;
using testing::Shape;

class HierarchyTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kLeafTriangles = 4;

  static bool meets(const Float3& lower, const Float3& upper, const Vec3& p, double half) {
    const Vec3 low = rendering::to_vec3(lower);
    const Vec3 high = rendering::to_vec3(upper);
    return (low.array() <= p.array() + half).all() && (high.array() >= p.array() - half).all();
  }
  // Triangles in the leaves that a cube about p meets.
  static std::size_t looked_at(const Hierarchy& hierarchy, const Vec3& p, double half) {
    return std::accumulate(
        hierarchy.nodes.begin(), hierarchy.nodes.end(), std::size_t{0},
        [&](std::size_t sum, const BvhNode& node) {
          return sum + (meets(node.lower, node.upper, p, half) ? node.triangle_count : 0U);
        });
  }
  // Triangles whose own box the cube meets: no hierarchy looks at fewer.
  static std::size_t least(const Shape& shape, const Vec3& p, double half) {
    return static_cast<std::size_t>(
        std::ranges::count_if(shape.triangles, [&](const TriangleIndices& t) {
          Float3 lower = shape.vertices[t[0]];
          Float3 upper = lower;
          for (const std::uint32_t v : t) {
            const Float3& corner = shape.vertices[v];
            lower = {std::min(lower.x, corner.x), std::min(lower.y, corner.y),
                     std::min(lower.z, corner.z)};
            upper = {std::max(upper.x, corner.x), std::max(upper.y, corner.y),
                     std::max(upper.z, corner.z)};
          }
          return meets(lower, upper, p, half);
        }));
  }
};

TEST_F(HierarchyTest, LooksAtFewMoreTrianglesThanItMust) {
  std::mt19937_64 random(31);
  for (const Shape& shape :
       {testing::icosphere(0.05, 4), testing::torus(0.05, 0.01, 100, 40),
        testing::prism(360, 0.05, 0.02), testing::height_field(0.1, 50, 0.01),
        testing::cone(200, 0.03, 0.1), testing::triangle_soup(5, 1000, 0.005)}) {
    const Hierarchy hierarchy = build_hierarchy(shape.vertices, shape.triangles);
    std::uniform_int_distribution<std::size_t> any(0, shape.vertices.size() - 1);
    std::size_t looked = 0;
    std::size_t must = 0;
    constexpr double kHalf_m = 0.002;
    for (int i = 0; i < std::max(40, testing::part_of(200)); ++i) {
      const Vec3 p = rendering::to_vec3(shape.vertices[any(random)]);
      looked += looked_at(hierarchy, p, kHalf_m);
      must += least(shape, p, kHalf_m) + kLeafTriangles;
    }
    EXPECT_LE(4 * looked, 5 * must) << shape.name;
  }
}

// The bottom and the top are fans of slivers; queries between them look at few triangles.
TEST_F(HierarchyTest, KeepsTheTwoEndsOfACylinderApart) {
  const Shape cylinder = testing::prism(360, 0.05, 0.02);
  const Hierarchy hierarchy = build_hierarchy(cylinder.vertices, cylinder.triangles);
  EXPECT_LE(looked_at(hierarchy, Vec3{0.028, 0.044, 0.003}, 0.002), 20U);
  EXPECT_EQ(looked_at(hierarchy, Vec3{0.0, 0.0, 0.0}, 0.002), 0U);
}

}  // namespace
}  // namespace tactus::host
