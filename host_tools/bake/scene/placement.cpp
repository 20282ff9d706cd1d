#include "host_tools/bake/scene/placement.h"

#include <cmath>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns the box of the vertices that belong to triangles: a stray point must neither move nor
// shrink the mesh.
Eigen::AlignedBox3d used_box(const ImportedMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const rendering::TriangleIndices& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      box.extend(mesh.vertices[vertex]);
    }
  }
  return box;
}

rendering::Float3 rounded(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

TriangleMesh place(const ImportedMesh& mesh, const Placement& placement) {
  Vec3 centre = Vec3::Zero();
  double scale = placement.scale;
  if (placement.longest_side_m) {
    const Eigen::AlignedBox3d box = used_box(mesh);
    const double longest = box.sizes().maxCoeff();
    if (!(longest > 0.0)) {
      throw InputError("all vertices are at one place; check the mesh");
    }
    centre = box.center();
    scale = *placement.longest_side_m / longest;
  }
  const Mat3 linear = placement.rotation.toRotationMatrix() * scale;
  TriangleMesh result{
      .vertices = {}, .triangles = mesh.triangles, .corner_places = mesh.corner_places};
  result.vertices.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    const rendering::Float3 p = rounded(placement.position_m + linear * (vertex - centre));
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw InputError("a vertex is too far away for a float after placing; check the scale");
    }
    result.vertices.push_back(p);
  }
  return result;
}

}  // namespace tactus::host
