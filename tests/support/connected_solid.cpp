#include "tests/support/connected_solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tactus::testing {
namespace {

using rendering::to_float3;
using rendering::to_vec3;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

ConnectedSolid::ConnectedSolid(const Shape& shape) : solid_(shape, rendering::Sides::one, {}) {
  const auto& triangles = solid_.shape().triangles;
  const auto& vertices = solid_.shape().vertices;
  struct Edge {
    std::uint64_t key;  // from, to
    std::uint32_t triangle;
  };
  const auto key = [](std::uint32_t from, std::uint32_t to) {
    return (std::uint64_t{from} << 32U) | to;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  std::vector<Vec3> normals(vertices.size(), Vec3::Zero());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = triangles[t][k];
      const Vec3 here = to_vec3(vertices[corner]);
      const Vec3 next = to_vec3(vertices[triangles[t][(k + 1) % 3]]) - here;
      const Vec3 previous = to_vec3(vertices[triangles[t][(k + 2) % 3]]) - here;
      edges.push_back({key(corner, triangles[t][(k + 1) % 3]), t});
      normals[corner] += angle_between(next, previous) * next.cross(previous).normalized();
    }
  }
  std::ranges::sort(edges, {}, &Edge::key);
  for (const auto& triangle : triangles) {
    auto& across = neighbours_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t back = key(triangle[(k + 1) % 3], triangle[k]);
      const auto found = std::ranges::lower_bound(edges, back, {}, &Edge::key);
      across[k] =
          found != edges.end() && found->key == back ? found->triangle : rendering::kNoTriangle;
    }
  }
  for (const Vec3& normal : normals) {
    vertex_normals_.push_back(to_float3(normal.normalized()));
  }
}

double winding_number(const Shape& shape, const Vec3& q) {
  double sum = 0.0;
  for (const auto& [i, j, k] : shape.triangles) {
    const Vec3 a = to_vec3(shape.vertices[i]) - q;
    const Vec3 b = to_vec3(shape.vertices[j]) - q;
    const Vec3 c = to_vec3(shape.vertices[k]) - q;
    // Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30(2), 1983.
    const double volume = a.dot(b.cross(c));
    const double below = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                         b.dot(c) * a.norm() + c.dot(a) * b.norm();
    sum += std::atan2(volume, below);
  }
  return sum / (2.0 * std::numbers::pi);
}

}  // namespace tactus::testing
