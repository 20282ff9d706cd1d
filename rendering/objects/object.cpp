#include "rendering/objects/object.h"

#include <cmath>

#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Returns true if the mesh has vertices, triangles and a hierarchy. Their contents are checked
// where the mesh comes from (rendering/scene/mesh_check.h).
bool usable_mesh(const MeshView& mesh) {
  return !mesh.vertices.empty() && !mesh.triangles.empty() && !mesh.nodes.empty();
}

// Returns true if the mesh has the neighbours and normals that methods without a proxy need.
bool has_features(const Object& object) {
  return object.neighbours.size() == object.mesh.triangles.size() &&
         object.vertex_normals.size() == object.mesh.vertices.size();
}

// Returns the box in the world about the eight corners of the formula's box.
Bounds bounds(const ImplicitSurface& implicit) {
  Bounds box{.lower_W = Vec3::Constant(kWorldBound_m), .upper_W = Vec3::Constant(-kWorldBound_m)};
  for (int corner = 0; corner < 8; ++corner) {
    const auto side = [&](int axis) {
      return (corner >> axis & 1) != 0 ? implicit.bounds_O.upper[axis]
                                       : implicit.bounds_O.lower[axis];
    };
    const Vec3 p_W = implicit.to_world({side(0), side(1), side(2)});
    box.lower_W = box.lower_W.cwiseMin(p_W);
    box.upper_W = box.upper_W.cwiseMax(p_W);
  }
  return box;
}

// Returns true if the motion has no waves, or the mesh deforms, has a normal for every vertex, and
// no wave takes one of them out of the world.
bool can_wave(const Object& object) {
  const double wave_m = std::abs(object.motion->wave_m);
  if (wave_m == 0.0) {
    return true;
  }
  const auto& vertices = object.mesh.vertices;
  const auto& normals = object.vertex_normals;
  bool good = object.deforms && normals.size() == vertices.size();
  for (std::size_t i = 0; good && i < vertices.size(); ++i) {
    const Vec3 farthest = to_vec3(vertices[i]).cwiseAbs() + wave_m * to_vec3(normals[i]).cwiseAbs();
    good = (farthest.array() <= kWorldBound_m).all();
  }
  return good;
}

// Returns true if the method can render the surface. Each method knows some kinds of surfaces only,
// see rendering/README.md.
bool touchable(const Object& object) {
  if (object.deforms && (object.surface != SurfaceKind::mesh || !meets_proxy(object))) {
    return false;
  }
  switch (object.surface) {
    case SurfaceKind::primitive:
      return valid(object.primitive) &&
             (meets_proxy(object) || object.method == ContactMethod::potential_field);
    case SurfaceKind::implicit:
      return follows_formula(object.method) && check(object.implicit.formula).has_value() &&
             object.implicit.scale_m > 0.0;
    default:
      return usable_mesh(object.mesh) && !follows_formula(object.method) &&
             (meets_proxy(object) || is_textbook_on_mesh(object.method) || has_features(object));
  }
}

}  // namespace

Bounds bounds_of(const Object& object) {
  switch (object.surface) {
    case SurfaceKind::primitive:
      return bounds(object.primitive);
    case SurfaceKind::implicit:
      return bounds(object.implicit);
    default:
      return {.lower_W = to_vec3(object.mesh.nodes[0].lower),
              .upper_W = to_vec3(object.mesh.nodes[0].upper)};
  }
}

bool usable(const Object& object) {
  if (object.motion != nullptr && !(valid(*object.motion) && can_wave(object))) {
    return false;
  }
  const bool can_be_body = !is_body(object) || (object.moves && !object.deforms &&
                                                object.motion == nullptr && meets_proxy(object));
  return can_be_body && touchable(object) &&
         (object.detail.empty() || renders_detail(object.method)) && object.push_out_m >= 0.0 &&
         object.push_out_m <= kWorldBound_m &&
         check(object.detail, object.mesh.triangles.size()).fault == DetailFault::none;
}

}  // namespace tactus::rendering
