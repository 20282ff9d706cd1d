// The triangles of a mesh that a body may meet in a tick, and which of them share an edge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/placed_hull.h"
#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// A triangle near a body, seen from the side that the body is on. The frame is the mesh's, O.
struct NearTriangle {
  // No triangle.
  static constexpr std::uint16_t kNone = 0xffff;

  // The numbers of its corners in the mesh, counter-clockwise as the body sees them, and the
  // corners, m.
  TriangleIndices numbers{};
  std::array<Vec3, 3> corners_O;
  // The unit normal toward the body's side.
  Vec3 normal_O = Vec3::UnitY();
  // The triangles across its edges, by their places in the list; edge k leads from corner k to the
  // next.
  std::array<std::uint16_t, 3> across{kNone, kNone, kNone};
  // False if the body's middle lies behind a surface that stops one side alone: the triangle then
  // touches nothing, and only says what its neighbours' edges are.
  bool stops = true;
};

// Lives for one body and one mesh; no heap.
class NearTriangles {
 public:
  // Finds the triangles that come within `margin_m` of the hull, whose place is given in the mesh's
  // frame. With more than kMaxNearTriangles it takes those at the hull's vertices, and
  // is_partial().
  void find(const MeshView& mesh, Sides sides, const PlacedHull& hull_O, double margin_m);

  [[nodiscard]] std::span<const NearTriangle> all() const { return {triangles_.data(), count_}; }
  // Returns true if triangles are missing: an edge without a neighbour is then not known to be
  // open.
  [[nodiscard]] bool is_partial() const { return is_partial_; }

 private:
  friend struct TriangleSearch;

  // Finds the neighbours.
  void connect();

  std::array<NearTriangle, kMaxNearTriangles> triangles_;
  std::size_t count_ = 0;
  bool is_partial_ = false;
};

}  // namespace tactus::rendering
