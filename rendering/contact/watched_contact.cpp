#include "rendering/contact/watched_contact.h"

#include <algorithm>

#include "rendering/objects/movers.h"

namespace tactus::rendering {
namespace {

// Returns the number of the triangle's vertex that is nearest to a point of the mesh's frame.
std::uint32_t nearest_vertex(const MeshView& mesh, std::uint32_t triangle, const Vec3& p_O) {
  const TriangleIndices& corners = mesh.triangles[triangle];
  return *std::ranges::min_element(corners, {}, [&](std::uint32_t vertex) {
    return (to_vec3(mesh.vertices[vertex]) - p_O).squaredNorm();
  });
}

}  // namespace

ExplainedFeature feature_of(const SceneObjects& scene, const ContactPlane& plane,
                            const Vec3& surface_W) {
  ExplainedFeature feature{.object = plane.object,
                           .kind = kind_of(plane.nearest.feature),
                           .face = plane.triangle,
                           .edge = plane.nearest.edge};
  if (plane.nearest.feature == Feature::vertex) {
    const Vec3 surface_O = point_in(scene.mover_of(plane.object), surface_W);
    feature.vertex = nearest_vertex(scene.mesh_O(plane.object).mesh, plane.triangle, surface_O);
  }
  return feature;
}

ExplainedFeature feature_of(const WatchedObject& object, const MeshFeature& feature) {
  const bool is_vertex = feature.kind == Feature::vertex;
  const MeshView& mesh = object.object->mesh;
  return {.object = object.number,
          .kind = kind_of(feature.kind),
          .face = feature.triangle,
          .edge = is_vertex ? std::uint32_t{0} : feature.number,
          .vertex = is_vertex ? mesh.triangles[feature.triangle][feature.number] : 0};
}

ExplainedFeature feature_of(const WatchedObject& object, const FacetHit& hit) {
  return {.object = object.number, .kind = ContactKind::face, .face = hit.triangle};
}

WatchedConstraints constraints_of(const WatchedSubGoal& sub_goal) {
  const Vec3& p_W = sub_goal.proxy.state.p_W;
  WatchedConstraints found{.planes = sub_goal.proxy.planes};
  ProxyRest rest;
  found.active =
      find_active_constraints(sub_goal.tick.near.scene, sub_goal.tick.factors, sub_goal.proxy.state,
                              sub_goal.tick.h_W, found.planes, rest);
  const auto& [projection, stiffness, push_m, circle, are_cones] = found.active;
  if (projection.active_count > 0 && are_cones) {
    const Vec3 from = projection.feasible ? found.planes.resting_position(p_W) : p_W;
    found.circle = {.static_radius_m = circle.static_radius_m,
                    .dynamic_radius_m = circle.dynamic_radius_m,
                    .lag_m = (from - projection.point).norm()};
  }
  return found;
}

}  // namespace tactus::rendering
