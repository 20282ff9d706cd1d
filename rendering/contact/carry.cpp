// The proxy wants to stay where the touched object takes it, or else where it is. An object that is
// in the way, seen from its own frame, gives the plane of where it was met, fixed to the object;
// the proxy goes to the point nearest to its wish that is in front of all planes, and is asked for
// again. As in a tick of contact a convex piece of surface lies behind its plane, so a straight way
// on the plane's front side does not meet it again: each round adds planes of surfaces not met
// before, and few are ever needed.
#include "rendering/contact/carry.h"

#include <algorithm>
#include <array>

#include "rendering/contact/object_cast.h"
#include "rendering/geometry/hierarchy_query.h"
#include "rendering/geometry/plane_projection.h"

namespace tactus::rendering {
namespace {

constexpr std::size_t kMaxPlanes = 24;
constexpr int kMaxRounds = 12;
constexpr std::size_t kMaxMeasured = 512;
// A sphere that overlaps a surface already is not thrown out of it.
constexpr double kMostPush_m = 1e-6;

struct Push {
  const Scenery& scenery;
  const Shells& shells;
  const Vec3& from_W;
  std::array<Plane, kMaxPlanes> planes{};
  std::size_t plane_count = 0;
  std::size_t room = kMaxMeasured;
  bool clear = true;  // in this round

  // The way that the object sees, from where the proxy was to goal_W.
  void ask(std::uint32_t number, const RigidPose& before, const RigidPose& now,
           const Vec3& goal_W) {
    const Vec3 from_O = before.point_in(from_W);
    const Vec3 way = now.point_in(goal_W) - from_O;
    const double length = way.norm();
    constexpr double kNothing_m = 1e-12;
    if (length <= kNothing_m) {
      return;
    }
    const Object& object = scenery[number];
    const Shell& shell = shells.of(is_point_tool(object));
    const Sweep sweep{.from = from_O, .direction = way / length};
    const ObjectHit hit = cast_on(object, {.sweep_O = sweep, .limit_m = length}, shell, room);
    if (hit.travel_m >= length) {
      return;
    }
    clear = false;
    if (!hit.met || plane_count == kMaxPlanes) {
      room = 0;
      return;
    }
    const Vec3 met_O = from_O + hit.travel_m * sweep.direction;
    const HitSurface surface = surface_at(object, hit, met_O);
    const Vec3 normal_W = now.direction(surface.normal_O);
    const double to_rest = std::min(shell.rest_m - surface.distance_m, kMostPush_m);
    planes[plane_count++] = {.normal = normal_W,
                             .offset = normal_W.dot(now.point(met_O)) + to_rest};
  }

  void ask_movers(const Vec3& goal_W) {
    for (const Mover& mover : scenery.movers()) {
      if (!meets_proxy(scenery[mover.object])) {
        continue;
      }
      const Vec3 from_O = mover.X_WO_before.point_in(from_W);
      const double length = (mover.X_WO.point_in(goal_W) - from_O).norm();
      if (mover.bounds_O.distance(from_O) <= length + shells.sphere.reach_m) {
        ask(mover.object, mover.X_WO_before, mover.X_WO, goal_W);
      }
    }
  }

  void ask_still(const Vec3& goal_W) {
    struct Visitor {
      Push& push;
      const Vec3& goal_W;
      double length;
      [[nodiscard]] double reach() const { return length; }
      void operator()(std::uint32_t place) {
        push.ask(push.scenery.still_object(place), {}, {}, goal_W);
      }
    };
    const Vec3 way = goal_W - from_W;
    const double length = way.norm();
    if (length > 0.0) {
      visit_along(scenery.still_nodes(), from_W, way / length, shells.sphere.reach_m,
                  Visitor{.push = *this, .goal_W = goal_W, .length = length});
    }
  }
};

// Past the objects that move, and up to those that stand still.
Vec3 up_to_still(const Scenery& scenery, const Shells& shells, const Vec3& from_W,
                 const Vec3& goal_W) {
  const Vec3 way = goal_W - from_W;
  const double length = way.norm();
  if (length <= 0.0) {
    return from_W;
  }
  std::size_t room = kMaxMeasured;
  const Sweep sweep{.from = from_W, .direction = way / length};
  return from_W + cast_on_still(scenery, shells, sweep, length, room) * sweep.direction;
}

}  // namespace

Carried carry(const Scenery& scenery, const Shells& shells, const Vec3& p_W,
              std::uint32_t touched) {
  Vec3 wish = p_W;
  if (touched != kNoObject) {
    if (const Mover* const mover = scenery.mover_of(touched); mover != nullptr && mover->moved) {
      wish = mover->X_WO.point(mover->X_WO_before.point_in(p_W));
    }
  }
  Push push{.scenery = scenery, .shells = shells, .from_W = p_W};
  Vec3 goal = wish;
  for (int round = 0; round < kMaxRounds; ++round) {
    push.clear = true;
    push.ask_movers(goal);
    push.ask_still(goal);
    if (push.clear) {
      return {.p_W = goal};
    }
    const PlaneProjection projection =
        project_on_planes(wish, std::span(push.planes).first(push.plane_count));
    if (!projection.feasible || push.room == 0) {
      break;
    }
    goal = projection.point;
  }
  return {.p_W = up_to_still(scenery, shells, p_W, wish), .flags = kTouchPinched};
}

}  // namespace tactus::rendering
