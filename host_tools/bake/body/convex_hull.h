// The convex hull of points as a polyhedron with few vertices, for bodies that meet one another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"

namespace tactus::host {

// A convex polyhedron whose faces are polygons. Every directed edge of a face is an edge of one
// other face in the other direction, every vertex belongs to three faces or more, and vertices less
// edges plus faces are 2.
struct ConvexHull {
  // A polygon: the inside is where normal . p <= offset_m.
  struct Face {
    // Indices into ConvexHull::vertices, counter-clockwise seen from outside.
    std::vector<std::uint32_t> vertices;
    Vec3 normal = Vec3::Zero();  // of unit length, outward
    // The largest normal . p of the hull's vertices p, m. The face's own vertices may lie deeper by
    // twice the tolerance.
    double offset_m = 0.0;
  };

  // A part of the given points, unchanged, in the frame of the points, m.
  std::vector<Vec3> vertices;
  std::vector<Face> faces;
  // The greatest distance of a given point from the hull, m. It is below the tolerance if no vertex
  // had to be left out.
  double left_out_m = 0.0;
};

// Returns the distance within which points count as being in one plane, m: four times that by which
// the largest coordinate is rounded when it is stored as a float.
double hull_tolerance_m(std::span<const Vec3> points);

// Returns the convex hull of the points. If it has more vertices than the limit, the result is a
// polyhedron within it: vertices are added one after the other, each the point that is farthest
// from the hull so far, until the limit is met. Faces whose vertices are in one plane within the
// tolerance are one. The result depends on the points alone, and not on their order unless
// distances are equal.
//
// Throws InputError, without a file name, for a point that is not finite, and for points that are
// all at one place, on a line or in a plane, to four times the tolerance. `most_vertices` must be
// at least 4.
ConvexHull convex_hull(std::span<const Vec3> points,
                       std::size_t most_vertices = rendering::kMaxHullVertices);
ConvexHull convex_hull(std::span<const rendering::Float3> points,
                       std::size_t most_vertices = rendering::kMaxHullVertices);

// Returns the faces cut into triangles over the hull's vertices, counter-clockwise seen from
// outside.
std::vector<rendering::TriangleIndices> to_triangles(const ConvexHull& hull);

// Returns the greatest distance of a point from the hull, m; 0 if all are inside.
double left_out_m(const ConvexHull& hull, std::span<const Vec3> points);

}  // namespace tactus::host
