// The proxy's desired position is where the object in contact carries it, or where it was. The
// motion to a goal, seen from the frame of each object, is swept. An object that blocks it gives
// the plane of the impact, fixed to the object. The next goal is the point nearest to the desired
// position in front of all planes, and it is swept again. A convex piece of surface lies behind its
// plane, so a segment in front of the plane does not meet it again: each round adds planes of new
// surfaces only, and few rounds are needed.
//
//   desired = p + X_now (X_before^-1 c) - c      carried by the point c in contact, else p
//   goal    = desired
//   repeat:  for each object O: sweep X_before^-1 p -> X_now^-1 goal in O, add the plane met
//            done if nothing was met
//            goal = the point nearest to `desired` in front of all planes
//
// The sweep is in the object's frame, so the object's speed does not matter: a fast object that
// jumps over the proxy in one tick is met as surely as a slow one. An object at rest has both poses
// equal.
//
// A triangle that deforms has no frame in which it is still, and is tested in another manner. Its
// corners x_i move on straight lines, and so does the proxy p. Their greatest height over it along
// a fixed direction n,
//
//   max_i n . (x_i(t) - p(t)),
//
// is the maximum of linear functions of time, and so it is convex. If it is negative at both ends
// of the tick, the two were apart throughout. The direction n is that from the triangle's nearest
// point to the proxy at the start. A triangle that is farther away than all motions together is not
// tested.
//
// There is no solution where moving objects close on the proxy from both sides, or where the
// rounds, the planes or the budget run out. Then the objects at rest hold the proxy and the moving
// ones pass over it (kTouchPinched); `left_out` keeps them from being felt until the proxy is clear
// of them.
#include "rendering/contact/carry_along.h"

#include <algorithm>
#include <array>

#include "rendering/contact/deforming_plane.h"
#include "rendering/contact/object_sweep.h"
#include "rendering/geometry/hierarchy_query.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/tick_budget.h"

namespace tactus::rendering {
namespace {

// The planes and the rounds of one tick. Beyond either the proxy counts as pinched.
constexpr std::size_t kMaxPlanes = 24;
constexpr int kMaxRounds = 12;
// A sphere that already overlaps a surface is pushed out by at most this per tick.
constexpr double kMostPush_m = 1e-6;

// The planes that one tick's motion has met so far.
struct MovingObstacles {
  const SceneObjects& scene;
  const ContactMargins& margins;
  // The proxy's position before the tick; world frame, m.
  const Vec3& from_W;
  const LeftOut& left_out;
  // The planes are fixed to their objects at the end of the tick; world frame.
  std::array<Plane, kMaxPlanes> planes{};
  std::size_t plane_count = 0;
  // The cost units left (tick_budget.h). 0 also says that the proxy is pinched.
  std::size_t cost_left = kMaxCarryBudget;
  // The cost units spent.
  std::size_t spent = 0;
  // True while nothing has blocked the goal of this round.
  bool clear = true;

  // Adds a plane that the proxy must stay in front of; world frame. One too many counts as pinched.
  void add(const Vec3& normal_W, double offset) {
    if (plane_count == kMaxPlanes) {
      cost_left = 0;
      return;
    }
    planes[plane_count++] = {.normal = normal_W, .offset = offset};
  }

  // Sweeps the proxy's motion to goal_W in the object's frame, from the pose before to the pose
  // now, and adds a plane if it is blocked. An object without motion has two equal poses.
  void meet_object(std::uint32_t number, const RigidPose& before, const RigidPose& now,
                   const Vec3& goal_W) {
    if (left_out.has(number)) {
      return;
    }
    const Vec3 from_O = before.point_in(from_W);
    const Vec3 motion = now.point_in(goal_W) - from_O;
    const double length = motion.norm();
    constexpr double kNothing_m = 1e-12;
    if (length <= kNothing_m) {
      return;
    }
    const ContactMargin& margin = margins.of(is_point_tool(scene[number]));
    const Sweep sweep{.from = from_O, .direction = motion / length};
    const std::size_t cost_before = cost_left;
    const ObjectHit hit =
        sweep_object(scene, number, {.sweep_O = sweep, .limit_m = length}, margin, cost_left);
    spent += cost_before - cost_left;
    if (hit.travel_m >= length) {
      return;
    }
    clear = false;
    // The budget ended the sweep: where the rest of the motion leads is not known.
    if (!hit.met) {
      cost_left = 0;
      return;
    }
    // The plane is that of the impact: through the surface's nearest point, fixed to the object
    // where it is now, and raised so that the proxy comes to its rest height.
    const Vec3 met_O = from_O + hit.travel_m * sweep.direction;
    const Nearest nearest = nearest_at(scene, number, hit.triangle, met_O);
    const Vec3 normal_W = now.direction(nearest.normal);
    const double to_rest = std::min(margin.rest_m - nearest.distance, kMostPush_m);
    add(normal_W, normal_W.dot(now.point(met_O)) + to_rest);
  }

  // Tests the proxy's motion to goal_W against the triangles of a mesh that deforms, and adds the
  // plane that it violates most.
  void meet_deforming(const Mover& mover, const Vec3& goal_W) {
    const Vec3 from_O = mover.X_WO_before.point_in(from_W);
    const Vec3 to_O = mover.X_WO.point_in(goal_W);
    const Object& object = scene[mover.object];
    const ContactMargin& margin = margins.of(is_point_tool(object));
    const DeformableMesh& deformable = *mover.deformable;
    DeformingPlane visitor{
        .deformable = deformable,
        .one_sided = object.sides == Sides::one,
        .margin = margin,
        .from_O = from_O,
        .to_O = to_O,
        .reach_m = margin.reach_m + deformable.step_m() + (to_O - from_O).norm()};
    visit_near(deformable.before().nodes, from_O, visitor);
    spent += visitor.spent;
    if (!visitor.broken) {
      return;
    }
    clear = false;
    const Vec3 normal_W = mover.X_WO.direction(visitor.plane_O.normal);
    add(normal_W, visitor.plane_O.offset + normal_W.dot(mover.X_WO.translation));
  }

  // Tests the objects that move or deform. One whose box the motion cannot reach is skipped.
  void meet_movers(const Vec3& goal_W) {
    const double distance = (goal_W - from_W).norm();
    for (const Mover& mover : scene.movers()) {
      if (mover.is_passed_by(from_W, distance, margins.sphere.reach_m) ||
          !meets_proxy(scene[mover.object]) || left_out.has(mover.object)) {
        continue;
      }
      const Vec3 from_O = mover.X_WO_before.point_in(from_W);
      const double length = (mover.X_WO.point_in(goal_W) - from_O).norm();
      if (mover.bounds_O.distance(from_O) > length + margins.sphere.reach_m) {
        continue;
      }
      if (mover.deformable != nullptr && mover.deformable->step_m() > 0.0) {
        meet_deforming(mover, goal_W);
      } else {
        meet_object(mover.object, mover.X_WO_before, mover.X_WO, goal_W);
      }
    }
  }

  // Tests the objects at rest along the segment to goal_W, through the hierarchy of their boxes.
  void meet_still(const Vec3& goal_W) {
    struct Visitor {
      MovingObstacles& obstacles;
      const Vec3& goal_W;
      double length;
      [[nodiscard]] double reach() const { return length; }
      void operator()(std::uint32_t place) {
        obstacles.meet_object(obstacles.scene.still_object(place), {}, {}, goal_W);
      }
    };
    const Vec3 motion = goal_W - from_W;
    const double length = motion.norm();
    if (length > 0.0) {
      visit_along(scene.still_nodes(), from_W, motion / length, margins.sphere.reach_m,
                  Visitor{.obstacles = *this, .goal_W = goal_W, .length = length});
    }
  }
};

// Returns the end of a sweep that ignores the objects that move and stops at those at rest; world
// frame, m. Adds its cost to `spent`.
Vec3 swept_to_still(const SceneObjects& scene, const ContactMargins& margins, const Vec3& from_W,
                    const Vec3& goal_W, const LeftOut& left_out, std::size_t& spent) {
  const Vec3 motion = goal_W - from_W;
  const double length = motion.norm();
  if (length <= 0.0) {
    return from_W;
  }
  std::size_t cost_left = kMaxCarryBudget;
  const Sweep sweep{.from = from_W, .direction = motion / length};
  const double travel_m =
      sweep_still_objects(scene, margins, sweep, length, cost_left, left_out).travel_m;
  spent += kMaxCarryBudget - cost_left;
  return from_W + travel_m * sweep.direction;
}

// A point of a surface before the tick and now; object frame, m.
struct MovedPoint {
  Vec3 before_O = Vec3::Zero();
  Vec3 now_O = Vec3::Zero();
};

// Returns the point of a mesh that deforms which was nearest to p_O. It moves with its triangle's
// corners by its barycentric weights, which are ratios of areas: with n = ab x ac the weight of
// corner b is ((at x ac) . n) / (n . n).
MovedPoint deformed_point(const DeformableMesh& deformable, std::uint32_t triangle,
                          const Vec3& p_O) {
  const auto corners = [&](const MeshView& mesh) -> std::array<Vec3, 3> {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return {to_vec3(mesh.vertices[a]), to_vec3(mesh.vertices[b]), to_vec3(mesh.vertices[c])};
  };
  const std::array<Vec3, 3> before = corners(deformable.before());
  const std::array<Vec3, 3> now = corners(deformable.now());
  const Nearest nearest = Triangle(before[0], before[1], before[2]).nearest(p_O);
  const Vec3 at = p_O - nearest.distance * nearest.normal - before[0];
  const Vec3 ab = before[1] - before[0];
  const Vec3 ac = before[2] - before[0];
  const Vec3 normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  const double b = area > 0.0 ? at.cross(ac).dot(normal) / area : 0.0;
  const double c = area > 0.0 ? ab.cross(at).dot(normal) / area : 0.0;
  const Vec3 moved =
      (1.0 - b - c) * (now[0] - before[0]) + b * (now[1] - before[1]) + c * (now[2] - before[2]);
  const Vec3 point_O = before[0] + at;
  return {.before_O = point_O, .now_O = point_O + moved};
}

// Returns the point of the object in contact that the proxy at p_O touches.
MovedPoint touched_point(const SceneObjects& scene, const Mover& mover, std::uint32_t triangle,
                         const Vec3& p_O) {
  if (mover.deformable != nullptr && mover.deformable->step_m() > 0.0) {
    return deformed_point(*mover.deformable, triangle, p_O);
  }
  const Nearest nearest = nearest_at(scene, mover.object, triangle, p_O);
  const Vec3 point_O = p_O - nearest.distance * nearest.normal;
  return {.before_O = point_O, .now_O = point_O};
}

// Returns the position to which the object in contact carries the proxy; world frame, m. The tool
// does not turn, so that an object that turns rolls on it: the proxy's centre goes along with the
// point that it touches, and stays as far above that point's surface.
Vec3 carried_position(const SceneObjects& scene, const Vec3& p_W, const LastContact& last_contact) {
  const Mover* const mover =
      last_contact.object == kNoObject ? nullptr : scene.mover_of(last_contact.object);
  if (mover == nullptr || !mover->moved) {
    return p_W;
  }
  const Vec3 p_O = mover->X_WO_before.point_in(p_W);
  const auto [before_O, now_O] = touched_point(scene, *mover, last_contact.triangle, p_O);
  const Vec3 above_O = p_O - before_O;
  Vec3 touched_W = mover->X_WO.point(now_O);
  const double height_m = above_O.norm();
  if (height_m == 0.0) {
    return touched_W;
  }
  const Vec3 above_W = mover->X_WO_before.direction(above_O);
  const Vec3 up_W = mover->X_WO.direction(above_O) / height_m;
  return touched_W + above_W + (height_m - up_W.dot(above_W)) * up_W;
}

}  // namespace

Carried carry_along(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p_W,
                    const LastContact& last_contact, const LeftOut& left_out) {
  const Vec3 desired = carried_position(scene, p_W, last_contact);
  MovingObstacles obstacles{
      .scene = scene, .margins = margins, .from_W = p_W, .left_out = left_out};
  Vec3 goal = desired;
  for (int round = 0; round < kMaxRounds; ++round) {
    obstacles.clear = true;
    obstacles.meet_movers(goal);
    obstacles.meet_still(goal);
    if (obstacles.clear) {
      return {.p_W = goal, .spent = obstacles.spent};
    }
    const PlaneProjection projection =
        project_on_planes(desired, std::span(obstacles.planes).first(obstacles.plane_count));
    if (!projection.feasible || obstacles.cost_left == 0) {
      break;
    }
    goal = projection.point;
  }
  std::size_t spent = obstacles.spent;
  const Vec3 p_still_W = swept_to_still(scene, margins, p_W, desired, left_out, spent);
  return {.p_W = p_still_W, .flags = kTouchPinched, .spent = spent};
}

}  // namespace tactus::rendering
