// The plane of a mesh that deforms which a motion of the proxy violates most. carry_along.cpp
// derives the test.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "rendering/contact/sphere_sweep.h"
#include "rendering/geometry/hierarchy_query.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/surface/deformable_mesh.h"
#include "rendering/tick_budget.h"

namespace tactus::rendering {

// Visits the triangles of a mesh that deforms and keeps the plane that the proxy's motion violates
// most. One plane a round is enough: the next round visits the others with the new goal.
struct DeformingPlane {
  const DeformableMesh& deformable;
  bool one_sided;
  const ContactMargin& margin;
  // The proxy at the start of the tick in the frame before, and the goal in the frame now; m.
  const Vec3& from_O;
  const Vec3& to_O;
  // The distance at the start beyond which no triangle can be met, m.
  double reach_m;
  // The largest violation so far as a negative gap, m. A smaller one than the initial is rounding.
  double least_gap_m = -1e-9;
  // The plane of that violation in the frame now, valid if it is `broken`.
  Plane plane_O{};
  bool broken = false;
  // The cost units spent.
  std::size_t spent = 0;

  // Returns how far the search must reach: the boxes of the hierarchy may lag the vertices by
  // slack_m().
  [[nodiscard]] double reach() const { return reach_m + deformable.slack_m(); }
  void operator()(std::uint32_t t) {
    // Most triangles of a leaf are too far away, and their boxes show it.
    spent += kCostOfLeafTriangle;
    if (offset_from_box(deformable.before(), t, from_O).squaredNorm() > reach_m * reach_m) {
      return;
    }
    spent += kCostOfMeasurement;
    const Triangle before = triangle_of(deformable.before(), t);
    const Nearest nearest = before.nearest(from_O);
    if (nearest.distance > reach_m || (one_sided && before.height(from_O) < 0.0)) {
      return;
    }
    // The triangle's height along the normal where it is now. At the start its highest point was
    // the nearest one, which lay `distance` below the proxy.
    const MeshView now = deformable.now();
    double support = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t corner : now.triangles[t]) {
      support = std::max(support, nearest.normal.dot(to_vec3(now.vertices[corner])));
    }
    // The proxy stays at its rest height over the plane, or where it was if that is nearer.
    const double offset = support + std::min(margin.rest_m, nearest.distance);
    const double gap = nearest.normal.dot(to_O) - offset;
    if (gap < least_gap_m) {
      least_gap_m = gap;
      plane_O = {.normal = nearest.normal, .offset = offset};
      broken = true;
    }
  }
};

}  // namespace tactus::rendering
