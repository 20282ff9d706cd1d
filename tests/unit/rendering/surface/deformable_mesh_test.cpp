// The steps of a mesh that deforms, and its boxes. The oracle asks every vertex.
#include "rendering/surface/deformable_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "rendering/geometry/hierarchy_query.h"
#include "rendering/tick_budget.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::kRough;
using testing::Solid;

constexpr double kSheetCell_m = 0.01;

// A sheet on which nothing moves for a while, then all of it, then single vertices; the numbers of
// vertices are no multiples of four. The oracle asks every vertex.
TEST(DeformableMesh, ItsStepIsTheLongestOfItsVertices) {
  constexpr std::uint64_t kSeed = 29;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto pool = std::make_unique<DeformablePool>();
  std::array<Solid, 3> sheets{Solid(testing::flat_sheet(kSheetCell_m, 1), Sides::two, kRough),
                              Solid(testing::flat_sheet(kSheetCell_m, 2), Sides::two, kRough),
                              Solid(testing::flat_sheet(kSheetCell_m, 5), Sides::two, kRough)};
  for (const Solid& sheet : sheets) {
    pool->vertices_used = pool->nodes_used = 0;
    DeformableMesh mesh;
    ASSERT_TRUE(mesh.start(sheet.object().mesh, *pool));
    const auto count = static_cast<std::uint32_t>(mesh.now().vertices.size());
    std::vector<Float3> last(mesh.now().vertices.begin(), mesh.now().vertices.end());
    for (int tick = 0; tick < 400; ++tick) {
      // Steps of all lengths: from those whose squares vanish in a float to those that are cut.
      const double size_m = std::pow(10.0, -25.0 * std::abs(unit(random)) - 1.5);
      const bool all = tick % 4 == 1;
      for (std::uint32_t i = 0; i < count && tick % 4 != 0; ++i) {
        if (all || random() % count == 0) {
          const Vec3 about = size_m < 1e-12 ? Vec3{Vec3::Zero()} : to_vec3(last[i]);
          ASSERT_TRUE(
              mesh.move_vertex(i, about + size_m * Vec3(unit(random), unit(random), unit(random))));
        }
      }
      mesh.begin_tick();
      double longest = 0.0;
      bool any = false;
      for (std::uint32_t i = 0; i < count; ++i) {
        ASSERT_EQ(mesh.before().vertices[i], last[i]) << "tick " << tick;
        const Float3& now = mesh.now().vertices[i];
        longest = std::max(longest, (to_vec3(now) - to_vec3(last[i])).norm());
        any = any || now != last[i];
        last[i] = now;
      }
      ASSERT_EQ(mesh.step_m() > 0.0, any) << "tick " << tick;
      ASSERT_GE(mesh.step_m(), longest) << "tick " << tick;
      ASSERT_LE(mesh.step_m(), 1.000002 * longest + 2e-19) << "tick " << tick;
      ASSERT_LE(longest, kMaxVertexStep_m * (1.0 + 1e-6)) << "tick " << tick;
    }
  }
}

// Boxes follow the motion in its measure, and when it ends they catch up.
TEST(DeformableMesh, ItsSlackIsAShareOfALeafAndVanishesAtRest) {
  const Solid ball(testing::icosphere(0.05, 4), Sides::one, kRough);
  const auto pool = std::make_unique<DeformablePool>();
  DeformableMesh mesh;
  ASSERT_TRUE(mesh.start(ball.object().mesh, *pool));
  double leaf_m = 0.0;
  for (const BvhNode& node : mesh.now().nodes) {
    const Vec3 sides = to_vec3(node.upper) - to_vec3(node.lower);
    leaf_m = node.is_leaf() ? std::max(leaf_m, sides.maxCoeff()) : leaf_m;
  }
  const std::vector<Float3> rest(mesh.now().vertices.begin(), mesh.now().vertices.end());
  std::size_t boxes_cost = 0;
  for (int tick = 1; tick <= 600; ++tick) {
    const double out = 1.0 + 0.1 * std::sin(0.005 * tick);
    for (std::uint32_t i = 0; i < rest.size() && tick <= 400; ++i) {
      ASSERT_TRUE(mesh.move_vertex(i, out * to_vec3(rest[i])));
    }
    const std::size_t cost = mesh.begin_tick();
    boxes_cost += tick <= 400 ? cost - rest.size() / kVertexStepsPerUnit : 0;
    ASSERT_LE(mesh.slack_m(), 0.25 * leaf_m + 2.0 * mesh.step_m()) << "tick " << tick;
  }
  EXPECT_EQ(mesh.slack_m(), 0.0);
  // Far fewer boxes are drawn than there are in all ticks together.
  EXPECT_LT(boxes_cost, 400 * std::min(kRefitNodes, mesh.now().nodes.size()) / kRefitsPerUnit / 4);
}

TEST(DeformableMesh, NoVertexIsOutsideABoxAboveItByMoreThanTheSlack) {
  constexpr std::uint64_t kSeed = 23;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  const Solid ball(testing::icosphere(0.05, 4), Sides::one, kRough);
  const auto pool = std::make_unique<DeformablePool>();
  DeformableMesh mesh;
  ASSERT_TRUE(mesh.start(ball.object().mesh, *pool));
  std::uniform_int_distribution<std::uint32_t> which(
      0, static_cast<std::uint32_t>(mesh.now().vertices.size()) - 1);
  double greatest_slack = 0.0;
  for (int tick = 0; tick < 200; ++tick) {
    for (int i = 0; i < 50 && tick < 150; ++i) {
      ASSERT_TRUE(mesh.move_vertex(which(random), {place(random), place(random), place(random)}));
    }
    mesh.begin_tick();
    greatest_slack = std::max(greatest_slack, mesh.slack_m());
    const MeshView now = mesh.now();
    // Boxes of inner nodes hold their children's but for the slack, so leaves and the root do.
    for (const BvhNode& node : now.nodes) {
      for (std::uint32_t t = node.first; node.is_leaf() && t < node.first + node.triangle_count;
           ++t) {
        for (const std::uint32_t corner : now.triangles[t]) {
          for (const BvhNode& above : {node, now.nodes[0]}) {
            ASSERT_LE(std::sqrt(squared_distance(above, to_vec3(now.vertices[corner]))),
                      mesh.slack_m() + 1e-9)
                << "seed 23, tick " << tick;
          }
        }
      }
    }
  }
  EXPECT_GT(greatest_slack, 0.0);
}

}  // namespace
}  // namespace tactus::rendering
