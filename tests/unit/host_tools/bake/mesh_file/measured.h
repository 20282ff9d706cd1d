// Measures an imported mesh by closed forms, for the tests of the readers.
#pragma once

#include <Eigen/Geometry>

#include "host_tools/bake/mesh_file/polygon_mesh.h"

namespace tactus::testing {

// The volume by the divergence theorem, in cubed units of the file.
inline double volume(const host::ImportedMesh& mesh) {
  double six_volumes = 0.0;
  for (const rendering::TriangleIndices& t : mesh.triangles) {
    six_volumes += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  }
  return six_volumes / 6.0;
}

// The area, in squared units of the file.
inline double area(const host::ImportedMesh& mesh) {
  double two_areas = 0.0;
  for (const rendering::TriangleIndices& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    two_areas += (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return two_areas / 2.0;
}

}  // namespace tactus::testing
