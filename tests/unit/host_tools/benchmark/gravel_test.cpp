#include "host_tools/benchmark/gravel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "host_tools/benchmark/benchmark_mesh.h"

namespace tactus::host {
namespace {

// A ball as its vertices say.
struct Ball {
  Vec3 middle;
  double radius_m = 0.0;
};

// Returns the balls of the mesh, whose vertices lie one ball after the other.
std::vector<Ball> balls_of(const TriangleMesh& mesh) {
  const std::size_t vertices = mesh.vertices.size() / kGravelBalls;
  std::vector<Ball> balls(kGravelBalls);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const std::span block = std::span(mesh.vertices).subspan(i * vertices, vertices);
    Vec3 sum = Vec3::Zero();
    for (const rendering::Float3& vertex : block) {
      sum += rendering::to_vec3(vertex);
    }
    balls[i].middle = sum / static_cast<double>(vertices);
    balls[i].radius_m = (rendering::to_vec3(block.front()) - balls[i].middle).norm();
    for (const rendering::Float3& vertex : block) {
      EXPECT_NEAR((rendering::to_vec3(vertex) - balls[i].middle).norm(), balls[i].radius_m, 1e-7);
    }
  }
  return balls;
}

TEST(Gravel, IsAThousandBallsOfThreeToFiveMillimetresInOneClosedMesh) {
  const BenchmarkMesh mesh = gravel_mesh();
  EXPECT_EQ(mesh.mesh.triangles.size(), kGravelBalls * kGravelBallTriangles);
  EXPECT_EQ(mesh.mesh.counters.open_edges, 0U);
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const Ball& ball : balls_of(gravel())) {
    smallest = std::min(smallest, ball.radius_m);
    largest = std::max(largest, ball.radius_m);
  }
  EXPECT_GE(smallest, 0.003 - 1e-7);
  EXPECT_LT(smallest, 0.0031);
  EXPECT_LE(largest, 0.005 + 1e-7);
  EXPECT_GT(largest, 0.0049);
}

TEST(Gravel, NeighboursOverlapALittleOrLeaveGaps) {
  constexpr double kNarrow_m = 0.001;
  const std::vector<Ball> balls = balls_of(gravel());
  std::size_t alone = 0;
  std::size_t narrow_gaps = 0;
  std::size_t overlaps = 0;
  double deepest_m = 0.0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const std::size_t before = overlaps;
    for (std::size_t k = 0; k < balls.size(); ++k) {
      const double gap_m =
          (balls[i].middle - balls[k].middle).norm() - balls[i].radius_m - balls[k].radius_m;
      if (i != k && gap_m <= 0.0) {
        ++overlaps;
        deepest_m = std::max(deepest_m, -gap_m);
      }
      narrow_gaps += gap_m > 0.0 && gap_m < kNarrow_m ? 1 : 0;
    }
    alone += overlaps == before ? 1 : 0;
  }
  EXPECT_LT(alone, kGravelBalls / 20);
  EXPECT_LT(deepest_m, kLeastGravelRadius_m) << "no ball reaches another's middle";
  EXPECT_GT(overlaps, kGravelBalls);
  EXPECT_GT(narrow_gaps, kGravelBalls / 2);
}

TEST(Gravel, HasTheSameBitsEverywhere) {
  const TriangleMesh mesh = gravel();
  // FNV-1a over the bits of the coordinates.
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const auto& [x, y, z] : mesh.vertices) {
    for (const float coordinate : {x, y, z}) {
      hash = (hash ^ std::bit_cast<std::uint32_t>(coordinate)) * 0x100000001B3U;
    }
  }
  EXPECT_EQ(hash, 11897410906156583369U);
}

}  // namespace
}  // namespace tactus::host
