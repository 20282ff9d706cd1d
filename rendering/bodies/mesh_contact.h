// The contact of a body with a triangle mesh.
#pragma once

#include <span>

#include "rendering/bodies/contact_patches.h"
#include "rendering/bodies/near_triangles.h"
#include "rendering/bodies/placed_hull.h"
#include "rendering/geometry/mesh.h"

namespace tactus::rendering {

// Finds where a body touches a mesh. Lives in static storage; no heap.
//
// Every contact of a convex solid with a surface of triangles is one of two kinds: a vertex of the
// solid over a triangle, with the triangle's normal; or an edge of the mesh, with its ends, at the
// solid. Edges at which the surface is flat or hollow touch nothing that their triangles do not
// touch, and are left out. At the other ones a normal counts only if the mesh lies behind the
// contact's plane all about: within the Voronoi region of the edge or the vertex. So a body that
// slides from triangle to triangle does not catch at the edges between.
class MeshContact {
 public:
  // Returns the manifolds in which the hull, whose place is given in the mesh's frame O, is nearer
  // than the margin; also in frame O. The mesh is A. Valid until the next call.
  std::span<const Manifold> find(const MeshView& mesh, Sides sides, const PlacedHull& hull_O,
                                 double margin_m);
  // Returns true if the last search has left out triangles.
  [[nodiscard]] bool has_left_out() const { return near_.is_partial(); }

 private:
  void add_vertices(const PlacedHull& hull_O, double margin_m);
  // Adds the contacts of a vertex with this radius.
  void add_vertex(const Vec3& vertex, double radius_m, double margin_m);
  void add_edges(Sides sides, const PlacedHull& hull_O, double margin_m);
  // Adds the contact of the edge k of a triangle.
  void add_edge(const NearTriangle& triangle, std::size_t k, Sides sides, const PlacedHull& hull_O,
                double margin_m);
  // Returns true if the surface bends away from the body at the edge, or ends there.
  [[nodiscard]] bool is_ridge(const NearTriangle& triangle, std::size_t k) const;
  // Returns true if the mesh lies behind the contact's plane about the edge.
  [[nodiscard]] bool is_outermost(const NearTriangle& triangle, std::size_t k, Sides sides,
                                  const Vec3& normal) const;

  NearTriangles near_;
  ContactPatches patches_;
  // The edge of the mesh that is looked at, as a hull.
  PlacedHull edge_;
};

}  // namespace tactus::rendering
