#include "host_tools/benchmark/gravel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host_tools/mesh/icosphere.h"
#include "host_tools/simulation/random.h"

namespace tactus::host {
namespace {

// The places lie on a cubic grid, at a little less than the distance at which balls of mean radius
// touch, and each is moved by at most kJitter_m along every axis.
constexpr int kBallsAlongEdge = 10;
constexpr double kGridStep_m = 0.0075;
constexpr double kJitter_m = 0.0005;
static_assert(std::size_t{kBallsAlongEdge} * kBallsAlongEdge * kBallsAlongEdge == kGravelBalls);

// Returns the middles of the balls, m, in the order of the grid.
std::vector<Vec3> jittered_grid(SplitMix64& random) {
  constexpr double kMiddle = 0.5 * (kBallsAlongEdge - 1);
  std::vector<Vec3> grid;
  grid.reserve(kGravelBalls);
  for (int x = 0; x < kBallsAlongEdge; ++x) {
    for (int y = 0; y < kBallsAlongEdge; ++y) {
      for (int z = 0; z < kBallsAlongEdge; ++z) {
        Vec3 place = kGridStep_m * Vec3{x - kMiddle, y - kMiddle, z - kMiddle};
        for (double& along : place) {
          along += random.uniform(-kJitter_m, kJitter_m);
        }
        grid.push_back(place);
      }
    }
  }
  return grid;
}

// Adds a ball to the mesh.
void add_ball(TriangleMesh& mesh, const Vec3& place, double radius_m) {
  constexpr int kSubdivisions = 2;
  const TriangleMesh ball = icosphere(radius_m, kSubdivisions);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const rendering::Float3& vertex : ball.vertices) {
    mesh.vertices.push_back(rendering::to_float3(place + rendering::to_vec3(vertex)));
  }
  for (const auto& [a, b, c] : ball.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
}

}  // namespace

TriangleMesh gravel() {
  constexpr std::uint64_t kSeed = 1;
  SplitMix64 random(kSeed);
  TriangleMesh mesh;
  mesh.triangles.reserve(kGravelBalls * kGravelBallTriangles);
  for (const Vec3& place : jittered_grid(random)) {
    add_ball(mesh, place, random.uniform(kLeastGravelRadius_m, kLargestGravelRadius_m));
  }
  return mesh;
}

}  // namespace tactus::host
