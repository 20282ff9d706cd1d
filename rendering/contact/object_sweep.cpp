// Sweeps against whole objects: a walk through the hierarchy along the line, nearest boxes first.
// Each triangle that blocks the sphere shortens the sweep, and with it the reach of the walk, so
// that most of what lies behind it is never looked at.
#include "rendering/contact/object_sweep.h"

#include <algorithm>
#include <cmath>

#include "rendering/contact/primitive_sweep.h"
#include "rendering/geometry/hierarchy_query.h"
#include "rendering/geometry/near_segment.h"
#include "rendering/tick_budget.h"

namespace tactus::rendering {
namespace {

// Visits the triangles near the segment and shortens the sweep to the first one that blocks it. It
// is a visitor of visit_along() (geometry/hierarchy_query.h); the members that its walk calls are
// public.
class TriangleSweep {
 public:
  TriangleSweep(const MeshView& mesh, bool one_sided, const ObjectSweep& sweep,
                const ContactMargin& margin, std::size_t& cost_left)
      : mesh_(mesh),
        one_sided_(one_sided),
        sweep_(sweep.sweep_O),
        margin_(margin),
        cost_left_(cost_left),
        hit_{.travel_m = sweep.limit_m},
        segment_(segment()) {}

  [[nodiscard]] const ObjectHit& hit() const { return hit_; }
  [[nodiscard]] double reach() const { return hit_.travel_m; }
  [[nodiscard]] bool exhausted() const { return cost_left_ == 0; }

  void boxes(std::uint32_t pairs) { add_work(kCostOfBoxPairAlongSweep * pairs); }

  void leaf(const BvhNode& leaf) {
    add_work(kCostOfLeafTriangle * leaf.triangle_count);
    segment_.find(mesh_, leaf.first, leaf.triangle_count,
                  [this](std::uint32_t t, const NearSegment::Bound&) { meet(t); });
  }

 private:
  // Returns the part of the sweep that is left, for the test of four triangles at once.
  [[nodiscard]] NearSegment segment() const {
    return {sweep_.from, hit_.travel_m * sweep_.direction, margin_.reach_m};
  }

  // Takes cost units from what is left, down to 0.
  void add_work(std::size_t units) { cost_left_ -= std::min(cost_left_, units); }

  // Sweeps against one triangle and keeps the shorter travel.
  void meet(std::uint32_t t) {
    add_work(kCostOfTriangleSweep);
    const Triangle triangle = triangle_of(mesh_, t);
    const double travel = travel_to_contact(triangle, one_sided_, sweep_, hit_.travel_m, margin_,
                                            triangle.nearest(sweep_.from));
    if (travel < hit_.travel_m) {
      hit_ = {.travel_m = travel, .met = true, .triangle = t};
      segment_ = segment();
    }
  }

  const MeshView& mesh_;
  bool one_sided_;
  const Sweep& sweep_;
  const ContactMargin& margin_;
  std::size_t& cost_left_;
  ObjectHit hit_;
  NearSegment segment_;
};

// Visits objects and shortens the sweep to the first one that blocks it.
struct ObjectsSweep {
  const SceneObjects& scene;
  const ContactMargins& margins;
  const Sweep& sweep_W;
  std::size_t& cost_left;
  const LeftOut& left_out;
  FirstHit first;

  [[nodiscard]] double reach() const { return first.travel_m; }
  void operator()(std::uint32_t place) { take(scene.still_object(place)); }

  void take(std::uint32_t number) {
    if (left_out.has(number)) {
      return;
    }
    const Mover* const mover = scene.mover_of(number);
    const Sweep sweep_O{.from = point_in(mover, sweep_W.from),
                        .direction = direction_in(mover, sweep_W.direction)};
    const ObjectHit hit =
        sweep_object(scene, number, {.sweep_O = sweep_O, .limit_m = first.travel_m},
                     margins.of(is_point_tool(scene[number])), cost_left);
    // A sweep that ran out of budget gives the free travel without an object.
    if (hit.travel_m < first.travel_m) {
      first = {.travel_m = hit.travel_m,
               .object = hit.met ? number : kNoObject,
               .triangle = hit.triangle};
    }
  }
};

// Sweeps against the objects at rest, and returns the visitor so that the movers can be added.
ObjectsSweep over_still(const SceneObjects& scene, const ContactMargins& margins,
                        const Sweep& sweep_W, double limit_m, std::size_t& cost_left,
                        const LeftOut& left_out) {
  ObjectsSweep visitor{.scene = scene,
                       .margins = margins,
                       .sweep_W = sweep_W,
                       .cost_left = cost_left,
                       .left_out = left_out,
                       .first = {.travel_m = limit_m}};
  visit_along(scene.still_nodes(), sweep_W.from, sweep_W.direction, margins.sphere.reach_m,
              visitor);
  return visitor;
}

}  // namespace

ObjectHit sweep_object(const SceneObjects& scene, std::uint32_t number, const ObjectSweep& sweep,
                       const ContactMargin& margin, std::size_t& cost_left) {
  const Object& object = scene[number];
  if (object.surface == SurfaceKind::primitive) {
    const double travel =
        travel_to_contact(object.primitive, object.sides, sweep.sweep_O, sweep.limit_m, margin,
                          sample(object.primitive, sweep.sweep_O.from));
    return {.travel_m = travel, .met = travel < sweep.limit_m};
  }
  const PlacedMesh placed = scene.mesh_O(number);
  TriangleSweep visitor(placed.mesh, object.sides == Sides::one, sweep, margin, cost_left);
  // The search ended at `visited`: beyond it there may be triangles that were not looked at.
  const double visited = visit_along(placed.mesh.nodes, sweep.sweep_O.from, sweep.sweep_O.direction,
                                     margin.reach_m + placed.slack_m, visitor);
  if (visited < visitor.hit().travel_m) {
    return {.travel_m = visited};
  }
  return visitor.hit();
}

Nearest nearest_at(const SceneObjects& scene, std::uint32_t number, std::uint32_t triangle,
                   const Vec3& p_O) {
  const Object& object = scene[number];
  if (object.surface == SurfaceKind::primitive) {
    return nearest_of(sample(object.primitive, p_O));
  }
  return triangle_of(scene.mesh_O(number).mesh, triangle).nearest(p_O);
}

FirstHit sweep_still_objects(const SceneObjects& scene, const ContactMargins& margins,
                             const Sweep& sweep_W, double limit_m, std::size_t& cost_left,
                             const LeftOut& left_out) {
  return over_still(scene, margins, sweep_W, limit_m, cost_left, left_out).first;
}

FirstHit sweep_all_objects(const SceneObjects& scene, const ContactMargins& margins,
                           const Sweep& sweep_W, double limit_m, std::size_t& cost_left,
                           const LeftOut& left_out) {
  ObjectsSweep visitor = over_still(scene, margins, sweep_W, limit_m, cost_left, left_out);
  for (const Mover& mover : scene.movers()) {
    if (mover.is_near(sweep_W.from, visitor.first.travel_m + margins.sphere.reach_m) &&
        meets_proxy(scene[mover.object])) {
      visitor.take(mover.object);
    }
  }
  return visitor.first;
}

}  // namespace tactus::rendering
