// Solids of revolution as meshes in double precision, for the masses of primitives.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "rendering/geometry/mesh.h"

namespace tactus::testing {

// A mesh whose vertices are in double precision.
struct PreciseMesh {
  std::vector<Vec3> vertices;
  std::vector<rendering::TriangleIndices> triangles;
};

// Turns a profile of points (r, y) about y. The profile runs upwards along the outside; it begins
// and ends on the axis, or at its own first point, as a ring's.
inline PreciseMesh turned_profile(const std::vector<Eigen::Vector2d>& profile,
                                  std::uint32_t sides) {
  PreciseMesh mesh;
  std::vector<std::uint32_t> first;
  for (const Eigen::Vector2d& q : profile) {
    if (!first.empty() && q == profile.front()) {
      first.push_back(first.front());
      continue;
    }
    first.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    for (std::uint32_t k = 0; k < (q.x() == 0.0 ? 1U : sides); ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      mesh.vertices.emplace_back(q.x() * std::cos(angle), q.y(), q.x() * std::sin(angle));
    }
  }
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const auto vertex = [&](std::size_t ring, std::uint32_t k) {
      return first[ring] + (profile[ring].x() == 0.0 ? 0 : k % sides);
    };
    for (std::uint32_t k = 0; k < sides; ++k) {
      if (profile[i].x() != 0.0) {
        mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i, k + 1)});
      }
      if (profile[i + 1].x() != 0.0) {
        mesh.triangles.push_back({vertex(i, k + 1), vertex(i + 1, k), vertex(i + 1, k + 1)});
      }
    }
  }
  return mesh;
}

}  // namespace tactus::testing
