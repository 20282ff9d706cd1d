// Makes a mesh of the surface in the cells of a tree by dual contouring (Ju, Losasso, Schaefer and
// Warren, "Dual contouring of Hermite data", SIGGRAPH 2002).
//
// Each cell that the surface passes through gets one vertex. It is placed where the tangent planes
// of the surface at the cell's edges meet, so edges and corners of the surface stay sharp. Each
// edge of a cell on which the formula changes its sign, and that no smaller cell cuts, gives a
// quadrilateral between the vertices of the four cells round it, or a triangle if two of them are
// one. So the mesh has no cracks where small cells are beside large ones.
#pragma once

#include <optional>
#include <vector>

#include "host_tools/bake/formula/cell_tree.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// A mesh of a formula's surface, in the formula's frame and units.
struct ContourMesh {
  std::vector<Vec3> vertices;
  // The cell of each vertex.
  std::vector<Leaf> cells;
  // Triangles face to where the formula is above 0.
  std::vector<rendering::TriangleIndices> triangles;
};

// Returns the mesh. It ends open at the bounds; it is empty if the formula has the same sign at all
// corners of cells.
ContourMesh dual_contour(const rendering::FormulaView& formula, const CellTree& tree);

// Returns the point on the surface that is nearest to p along a line in that unit direction, within
// `most` of p; nothing if the formula keeps its sign there. Formula's frame and units.
std::optional<Vec3> surface_along(const rendering::FormulaView& formula, const Vec3& p,
                                  const Vec3& direction, double most);

}  // namespace tactus::host
