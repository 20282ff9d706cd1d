// Puts an imported mesh into the world.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "host_tools/bake/scene/mesh_cleanup.h"
#include "host_tools/bake/scene/mesh_import.h"

namespace tactus::host {

// p_W = position + rotation * scale * (p - centre). With longest_side_m the centre is that of the
// mesh's box and the scale makes the box's longest side that long, both before rotation; without it
// the centre is the mesh's own origin.
struct Placement {
  std::optional<double> longest_side_m;
  double scale = 1.0;  // m per unit of the file; unused with longest_side_m
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 position_m = Vec3::Zero();
};

// Calculates in double, rounds once, to float. Throws InputError, without a file name, when all
// vertices are at one place and longest_side_m is given, and when a result does not fit a float.
TriangleMesh place(const ImportedMesh& mesh, const Placement& placement);

}  // namespace tactus::host
