// A hull of triangles that grows by one point at a time. A step of convex_hull.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host_tools/bake/body/hull_lattice.h"
#include "rendering/geometry/mesh.h"
#include "rendering/geometry/triangle.h"

namespace tactus::host {

// Grows a convex hull on a lattice. Its triangles are convex without any tolerance, those in one
// plane included, and none is without area, since HullLattice::side() is exact.
class GrowingHull {
 public:
  // Begins with the tetrahedron of four points that are not in one plane. The lattice must outlive
  // the hull.
  GrowingHull(const HullLattice& lattice, const std::array<std::uint32_t, 4>& corners);

  // Returns the distance of a point from the hull, in units of the lattice; 0 inside.
  [[nodiscard]] double distance(std::uint32_t point) const;

  // Takes a point into the hull, and returns false if it is inside.
  bool add(std::uint32_t point);

  // Returns the number of the vertices.
  [[nodiscard]] std::size_t vertex_count() const { return faces_.size() / 2 + 2; }
  // Returns the triangles, counter-clockwise seen from outside, with indices of points.
  [[nodiscard]] std::vector<rendering::TriangleIndices> triangles() const;

 private:
  struct HullTriangle {
    rendering::TriangleIndices corners;
    rendering::Triangle shape;  // in units of the lattice
  };

  void add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  const HullLattice* lattice_;
  std::vector<HullTriangle> faces_;
};

}  // namespace tactus::host
