#include "rendering/world/object.h"

namespace tactus::rendering {
namespace {

bool usable(const MeshView& mesh) {
  return !mesh.vertices.empty() && !mesh.triangles.empty() && !mesh.nodes.empty();
}

bool has_features(const Object& object) {
  return object.neighbours.size() == object.mesh.triangles.size() &&
         object.vertex_normals.size() == object.mesh.vertices.size();
}

}  // namespace

bool usable(const Object& object) {
  switch (object.surface) {
    case SurfaceKind::primitive:
      return valid(object.primitive) &&
             (meets_proxy(object) || object.method == ContactMethod::potential_field);
    case SurfaceKind::implicit:
      return object.method == ContactMethod::tracking &&
             check(object.implicit.formula).has_value() && object.implicit.scale_m > 0.0;
    default:
      return usable(object.mesh) && object.method != ContactMethod::tracking &&
             (meets_proxy(object) || has_features(object));
  }
}

}  // namespace tactus::rendering
