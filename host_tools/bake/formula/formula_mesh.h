// Makes a triangle mesh of a formula's surface, so that a sphere, or any other contact of meshes,
// can touch it. The baker calls it.
#pragma once

#include <cstddef>
#include <functional>

#include "host_tools/bake/mesh_file/polygon_mesh.h"
#include "rendering/surface/implicit_surface.h"

namespace tactus::host {

// The distance between a formula's mesh and its surface that baking allows unless a scene says
// otherwise, m.
inline constexpr double kDefaultFormulaTolerance_m = 1e-5;

// The demands on a mesh.
struct FormulaMeshPlan {
  // The largest distance of the mesh from the surface, m.
  double tolerance_m = kDefaultFormulaTolerance_m;
  // The length of the formula's unit, m.
  double unit_m = 1.0;
  // The most triangles that the mesh may have.
  std::size_t most_triangles = 2'000'000;
  // Called with the number of triangles of each mesh that is not near enough yet; may be empty.
  std::function<void(std::size_t triangles)> progress;
};

// Returns the mesh in the formula's frame and units. Faces look to where the formula is above 0;
// it ends open at the bounds. The corners of each triangle lie on the surface, and so does a point
// within the tolerance of the middles of its sides and of the triangle: the formula changes its
// sign there. A note says where parts of the surface are nearer to each other than the mesh can
// tell. Throws InputError, without a file name, if the formula does not change its sign or needs
// too many triangles.
ImportedMesh mesh_formula(const rendering::FormulaView& formula, const rendering::Box& bounds,
                          const FormulaMeshPlan& plan);

}  // namespace tactus::host
