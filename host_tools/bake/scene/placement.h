// Puts an imported mesh into the world.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "host_tools/bake/mesh_file/mesh_import.h"
#include "host_tools/bake/scene/mesh_cleanup.h"

namespace tactus::host {

// The map p_W = position + rotation * scale * (p - centre). With `longest_side_m`, the centre is
// that of the mesh's box, and the scale makes the longest side of the box that long, both before
// rotation. Without it the centre is the origin of the mesh's file.
struct Placement {
  // The length of the box's longest side in the world, m.
  std::optional<double> longest_side_m;
  // Metres for a unit of the file; ignored if `longest_side_m` is given.
  double scale = 1.0;
  // The rotation from the file's axes to the world's.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  // The place of the object's centre in the world, m.
  Vec3 position_m = Vec3::Zero();
};

// Returns the mesh in the world frame, m. It is computed in double and rounded to float once.
// Throws InputError, without a file name, if `longest_side_m` is given and all vertices are at one
// place, or if a coordinate does not fit into a float.
TriangleMesh place(const ImportedMesh& mesh, const Placement& placement);

}  // namespace tactus::host
