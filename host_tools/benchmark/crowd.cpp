#include "host_tools/benchmark/crowd.h"

#include <algorithm>
#include <cmath>

#include "host_tools/mesh/icosphere.h"

namespace tactus::host {
namespace {

// The balls' radius, and the distance of neighbours from middle to middle.
constexpr double kRadius_m = 0.01;
constexpr double kApart_m = 0.03;

// Returns points of a cubic grid, the nearest to the origin first, m.
std::vector<Vec3> places(std::size_t count) {
  const int half = static_cast<int>(std::ceil(0.5 * std::cbrt(static_cast<double>(count)))) + 1;
  std::vector<Vec3> grid;
  for (int x = -half; x <= half; ++x) {
    for (int y = -half; y <= half; ++y) {
      for (int z = -half; z <= half; ++z) {
        grid.emplace_back(kApart_m * x, kApart_m * y, kApart_m * z);
      }
    }
  }
  std::ranges::stable_sort(grid, {}, [](const Vec3& p) { return p.squaredNorm(); });
  grid.resize(count);
  return grid;
}

// Returns a ball of 320 triangles.
BakedMesh ball_at(const Vec3& place) {
  constexpr int kSubdivisions = 2;
  TriangleMesh ball = icosphere(kRadius_m, kSubdivisions);
  for (rendering::Float3& vertex : ball.vertices) {
    const Vec3 p = rendering::to_vec3(vertex) + place;
    vertex = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  }
  return bake_mesh(ball.vertices, ball.triangles);
}

}  // namespace

Crowd::Crowd(std::size_t count) {
  const std::vector<Vec3> grid = places(count);
  meshes_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    rendering::Object object{
        .material = {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(0.6, 0.4)}};
    if (i % 2 == 0) {
      object.mesh = meshes_.emplace_back(ball_at(grid[i])).view();
    } else {
      object.surface = rendering::SurfaceKind::primitive;
      object.primitive = {.kind = rendering::PrimitiveKind::sphere,
                          .X_WO = {.translation = grid[i]},
                          .dimensions_m = {kRadius_m}};
    }
    objects_.push_back(object);
  }
}

}  // namespace tactus::host
