#include "rendering/contact/object_cast.h"

#include <algorithm>
#include <cmath>

#include "rendering/contact/primitive_sweep.h"
#include "rendering/contact/work.h"
#include "rendering/geometry/hierarchy_query.h"
#include "rendering/geometry/near_way.h"

namespace tactus::rendering {
namespace {

// Shrinks to the first triangle that stops the sphere.
class TriangleCast {
 public:
  TriangleCast(const MeshView& mesh, bool one_sided, const ObjectCast& cast, const Shell& shell,
               std::size_t& room)
      : mesh_(mesh),
        one_sided_(one_sided),
        sweep_(cast.sweep_O),
        shell_(shell),
        room_(room),
        hit_{.travel_m = cast.limit_m},
        way_(way()) {}

  [[nodiscard]] const ObjectHit& hit() const { return hit_; }
  [[nodiscard]] double reach() const { return hit_.travel_m; }
  [[nodiscard]] bool exhausted() const { return room_ == 0; }

  void boxes(std::uint32_t pairs) { add_work(kWorkOfBoxesAlong * pairs); }

  void leaf(const BvhNode& leaf) {
    add_work(kWorkOfALook * leaf.triangle_count);
    way_.find(mesh_, leaf.first, leaf.triangle_count,
              [this](std::uint32_t t, const NearWay::Bound&) { meet(t); });
  }

 private:
  [[nodiscard]] NearWay way() const {
    return {sweep_.from, hit_.travel_m * sweep_.direction, shell_.reach_m};
  }

  void add_work(std::size_t units) { room_ -= std::min(room_, units); }

  void meet(std::uint32_t t) {
    add_work(kWorkOfAMeeting);
    const Triangle triangle = triangle_of(mesh_, t);
    const double travel = travel_to_contact(triangle, one_sided_, sweep_, hit_.travel_m, shell_,
                                            triangle.nearest(sweep_.from));
    if (travel < hit_.travel_m) {
      hit_ = {.travel_m = travel, .met = true, .triangle = t};
      way_ = way();
    }
  }

  const MeshView& mesh_;
  bool one_sided_;
  const Sweep& sweep_;
  const Shell& shell_;
  std::size_t& room_;
  ObjectHit hit_;
  NearWay way_;
};

// Goes over objects.
struct CastOnObjects {
  const Scenery& scenery;
  const Shells& shells;
  const Sweep& sweep_W;
  std::size_t& room;
  const LeftOut& left_out;
  FirstHit first;

  [[nodiscard]] double reach() const { return first.travel_m; }
  void operator()(std::uint32_t place) { take(scenery.still_object(place)); }

  void take(std::uint32_t number) {
    if (left_out.has(number)) {
      return;
    }
    const Mover* const mover = scenery.mover_of(number);
    const Sweep sweep_O{.from = point_in(mover, sweep_W.from),
                        .direction = direction_in(mover, sweep_W.direction)};
    const ObjectHit hit = cast_on(scenery, number, {.sweep_O = sweep_O, .limit_m = first.travel_m},
                                  shells.of(is_point_tool(scenery[number])), room);
    if (hit.travel_m < first.travel_m) {
      first = {.travel_m = hit.travel_m,
               .object = hit.met ? number : kNoObject,
               .triangle = hit.triangle};
    }
  }
};

CastOnObjects over_still(const Scenery& scenery, const Shells& shells, const Sweep& sweep_W,
                         double limit_m, std::size_t& room, const LeftOut& left_out) {
  CastOnObjects visitor{.scenery = scenery,
                        .shells = shells,
                        .sweep_W = sweep_W,
                        .room = room,
                        .left_out = left_out,
                        .first = {.travel_m = limit_m}};
  visit_along(scenery.still_nodes(), sweep_W.from, sweep_W.direction, shells.sphere.reach_m,
              visitor);
  return visitor;
}

}  // namespace

ObjectHit cast_on(const Scenery& scenery, std::uint32_t number, const ObjectCast& cast,
                  const Shell& shell, std::size_t& room) {
  const Object& object = scenery[number];
  if (object.surface == SurfaceKind::primitive) {
    const double travel =
        travel_to_contact(object.primitive, object.sides, cast.sweep_O, cast.limit_m, shell,
                          sample(object.primitive, cast.sweep_O.from));
    return {.travel_m = travel, .met = travel < cast.limit_m};
  }
  const PlacedMesh placed = scenery.mesh_O(number);
  TriangleCast visitor(placed.mesh, object.sides == Sides::one, cast, shell, room);
  const double visited = visit_along(placed.mesh.nodes, cast.sweep_O.from, cast.sweep_O.direction,
                                     shell.reach_m + placed.slack_m, visitor);
  if (visited < visitor.hit().travel_m) {
    return {.travel_m = visited};
  }
  return visitor.hit();
}

Nearest nearest_at(const Scenery& scenery, std::uint32_t number, std::uint32_t triangle,
                   const Vec3& p_O) {
  const Object& object = scenery[number];
  if (object.surface == SurfaceKind::primitive) {
    return nearest_of(sample(object.primitive, p_O));
  }
  return triangle_of(scenery.mesh_O(number).mesh, triangle).nearest(p_O);
}

FirstHit cast_on_still(const Scenery& scenery, const Shells& shells, const Sweep& sweep_W,
                       double limit_m, std::size_t& room, const LeftOut& left_out) {
  return over_still(scenery, shells, sweep_W, limit_m, room, left_out).first;
}

FirstHit cast_on_all(const Scenery& scenery, const Shells& shells, const Sweep& sweep_W,
                     double limit_m, std::size_t& room, const LeftOut& left_out) {
  CastOnObjects visitor = over_still(scenery, shells, sweep_W, limit_m, room, left_out);
  for (const Mover& mover : scenery.movers()) {
    if (meets_proxy(scenery[mover.object]) &&
        mover.distance(sweep_W.from) <= visitor.first.travel_m + shells.sphere.reach_m) {
      visitor.take(mover.object);
    }
  }
  return visitor.first;
}

}  // namespace tactus::rendering
