// The contact of a sub-goal in the words of an explanation: which feature a plane belongs to, and
// which planes and friction circles hold the goal. For watchers (tick_watcher.h). No heap.
#pragma once

#include <cstdint>
#include <optional>

#include "rendering/contact/active_constraints.h"
#include "rendering/contact/contact_planes.h"
#include "rendering/contact/feature_walk.h"
#include "rendering/contact/tick_watcher.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// A place on a mesh, or on a primitive, which has faces only.
struct ExplainedFeature {
  std::uint32_t object = 0;
  ContactKind kind = ContactKind::none;
  // The number of the triangle in its mesh.
  std::uint32_t face = 0;
  // The number of the edge in its triangle, 0 to 2; for an edge only.
  std::uint32_t edge = 0;
  // The number of the vertex in its mesh; for a vertex only.
  std::uint32_t vertex = 0;

  bool operator==(const ExplainedFeature&) const = default;
};

// Returns the feature that gives the plane. `surface_W` is its point nearest to the proxy, m.
ExplainedFeature feature_of(const SceneObjects& scene, const ContactPlane& plane,
                            const Vec3& surface_W);

// Returns the feature at which a walk has ended its tick.
ExplainedFeature feature_of(const WatchedObject& object, const MeshFeature& feature);

// Returns the facet that a segment crosses.
ExplainedFeature feature_of(const WatchedObject& object, const FacetHit& hit);

// Returns the point of the plane's surface that is nearest to the proxy; world frame, m.
inline Vec3 surface_of(const ContactPlane& plane, const Vec3& proxy_W) {
  return proxy_W - plane.nearest.distance * plane.nearest.normal;
}

// The friction circles about the point without friction, and the distance of the proxy from that
// point before the move.
struct ExplainedCircle {
  double static_radius_m = 0.0;
  double dynamic_radius_m = 0.0;
  double lag_m = 0.0;

  bool operator==(const ExplainedCircle&) const = default;
};

// The constraints of a sub-goal, found once more from its planes.
struct WatchedConstraints {
  ContactPlanes planes;
  ActiveConstraints active;
  // Nothing without contact, or if a surface has another model than the cone.
  std::optional<ExplainedCircle> circle;
};

// Returns the constraints of the sub-goal.
WatchedConstraints constraints_of(const WatchedSubGoal& sub_goal);

}  // namespace tactus::rendering
