// What a scene hands to the world: views of memory that the caller keeps alive and unchanged.
// Nothing here owns or copies.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Three vertex indices, counter-clockwise seen from the front side.
using TriangleIndices = std::array<std::uint32_t, 3>;
static_assert(sizeof(TriangleIndices) == 12);

// One node of a bounding-volume hierarchy, 32 bytes. The root is node 0; the two children of an
// inner node are adjacent. Boxes are rounded outwards, so that no vertex lies outside the box of a
// node above it.
struct BvhNode {
  Float3 lower;  // m, world frame
  std::uint32_t first =
      0;         // inner node: index of the left child (right is first + 1); leaf: first triangle
  Float3 upper;  // m, world frame
  std::uint32_t triangle_count = 0;  // 0 for an inner node

  [[nodiscard]] bool is_leaf() const { return triangle_count != 0; }
};
static_assert(sizeof(BvhNode) == 32);

// A triangle mesh in the world frame. Triangles are stored in the order of the hierarchy's leaves.
struct MeshView {
  std::span<const Float3> vertices;
  std::span<const TriangleIndices> triangles;
  std::span<const BvhNode> nodes;
};

// Which side of a triangle stops the tool.
enum class Sides : std::uint8_t {
  one,  // only the front (counter-clockwise) side: for closed, consistently wound meshes
  two,  // both: for open and non-orientable meshes, which have no inside
};

// Melder and Harwin's friction cone: coefficients of the sticking and of the slipping state, >= 0.
struct ConeFriction {
  double static_coefficient = 0.0;
  double dynamic_coefficient = 0.0;
};

struct Material {
  double stiffness_N_per_m = 0.0;  // K of F = K (proxy - tool) - B v
  double damping_Ns_per_m = 0.0;   // B
  ConeFriction friction;
};

struct Object {
  MeshView mesh;
  Sides sides = Sides::one;
  Material material;
};

}  // namespace tactus::rendering
