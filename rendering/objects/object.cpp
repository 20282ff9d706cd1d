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

// Returns true if the surface is whole.
bool has_surface(const Object& object) {
  switch (object.surface) {
    case SurfaceKind::primitive:
      return valid(object.primitive);
    case SurfaceKind::implicit:
      return check(object.implicit.formula).has_value() && object.implicit.scale_m > 0.0;
    default:
      return usable_mesh(object.mesh);
  }
}

// Returns true if the method can render the surface with its detail, and a body by its proxy.
bool renders(ContactMethod method, const Object& object) {
  const bool is_mesh = object.surface == SurfaceKind::mesh;
  const bool needs_features = is_mesh && !meets_proxy(method) && !is_textbook_on_mesh(method);
  return renders_surface(method, object.surface) && (!is_body(object) || meets_proxy(method)) &&
         (!object.deforms || (is_mesh && renders_deforming(method))) &&
         (!needs_features || has_features(object)) &&
         (object.detail.empty() || renders_detail(method));
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
  const bool can_be_body =
      !is_body(object) || (object.moves && !object.deforms && object.motion == nullptr);
  return can_be_body && has_surface(object) && renders(object.method, object) &&
         object.push_out_m >= 0.0 && object.push_out_m <= kWorldBound_m &&
         check(object.detail, object.mesh.triangles.size()).fault == DetailFault::none;
}

bool can_render(ContactMethod method, const Object& object, const Material& material) {
  return renders(method, object) && renders_friction(method, material.friction) &&
         (!material.grain.differs() || renders_grain(method));
}

}  // namespace tactus::rendering
