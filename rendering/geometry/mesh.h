// A triangle mesh as a scene hands it over: views of memory that the caller keeps alive and
// unchanged. Baking (host_tools/bake) makes the arrays, SceneImage checks them, and the geometry,
// surface and contact rooms read them in every tick.
#pragma once

#include <array>
#include <cstddef>
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
  // The box's corners with the least and the greatest coordinates, m, in the frame of the mesh.
  Float3 lower;
  std::uint32_t first =
      0;         // inner node: index of the left child (right is first + 1); leaf: first triangle
  Float3 upper;  // m, world frame
  // The number of triangles of a leaf, which follow each other; 0 for an inner node.
  std::uint32_t triangle_count = 0;

  // Returns true for a leaf.
  [[nodiscard]] bool is_leaf() const { return triangle_count != 0; }
};
static_assert(sizeof(BvhNode) == 32);
// A corner and the integer beside it are read as four floats.
static_assert(offsetof(BvhNode, first) == sizeof(Float3) &&
              offsetof(BvhNode, triangle_count) == 16 + sizeof(Float3));

// A mesh, m. Its frame is the world's, or the object's own for one that moves. Triangles are stored
// in the order of the hierarchy's leaves.
struct MeshView {
  std::span<const Float3> vertices;
  std::span<const TriangleIndices> triangles;
  std::span<const BvhNode> nodes;
};

// The sides of a surface that stop the tool.
enum class Sides : std::uint8_t {
  one,  // only the front side (of a triangle: counter-clockwise): for surfaces with an inside
  two,  // both: for open and non-orientable surfaces
};

}  // namespace tactus::rendering
