// Chooses the end of the proxy's next straight move: the third and the fourth step of a sub-goal
// (proxy_tick.cpp).
#pragma once

#include "rendering/contact/active_constraints.h"
#include "rendering/contact/curved_path.h"
#include "rendering/contact/friction_hold.h"
#include "rendering/contact/moving_proxy.h"
#include "rendering/contact/round_walls.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The end of the next straight move.
struct SubGoal {
  Vec3 point = Vec3::Zero();  // world frame, m
  // The tool, or where friction makes it seem to be; world frame, m.
  Vec3 tool = Vec3::Zero();
  bool settled = false;     // there is no move: the proxy is where it belongs
  bool lengthened = false;  // by CurvedPath
};

// One object chooses the sub-goals of one tick, and keeps what one leaves to the next.
class SubGoalChooser {
 public:
  // Projects the tool on the planes, holds the proxy by friction and lengthens the move on a curved
  // path. A move below kSettled_m is none. Writes the active planes to the proxy's rest, and its
  // friction state.
  SubGoal choose(const ProxyMove& tick, const MovingProxy& proxy);

  // Takes note that the proxy moves from p (world frame, m) to `goal`, held by the planes of
  // `rest`.
  void leave(const Vec3& p, const SubGoal& goal, const ProxyRest& rest) {
    if (rest.plane_count == 2) {
      curve_.remember_crease(goal.lengthened ? Vec3{Vec3::Zero()} : Vec3{goal.point - p});
    }
  }

 private:
  CurvedPath curve_;
  // True once the proxy slipped in this tick: it then slips in the rest of it.
  bool slipped_ = false;
};

// Inline, because every sub-goal takes this path.
inline SubGoal SubGoalChooser::choose(const ProxyMove& tick, const MovingProxy& proxy) {
  auto& [state, planes, rest] = proxy;
  const NearbySurfaces& near = tick.near;
  const Vec3& p = state.p_W;
  const Vec3& h = tick.h_W;
  const ActiveConstraints active =
      find_active_constraints(near.scene, tick.factors, state, h, planes, rest);
  if (active.projection.active_count == 0) {
    const bool arrived = (h - p).squaredNorm() <= 0.0;
    if (arrived) {
      state.friction = FrictionState::free;
    }
    return {.point = h, .tool = h, .settled = arrived};
  }
  const HeldGoal held = hold_by_friction(near.scene, active, rest, h, planes, state, slipped_);
  if (held.sticks) {
    return {.point = held.point, .tool = held.tool, .settled = held.settled};
  }
  const Vec3& pulled_to = active.are_cones ? active.projection.point : held.point;
  const Vec3 point = touches_round_wall(near.candidates, rest)
                         ? goal_on_walls({near, planes, rest, p}, pulled_to, held)
                         : held.point;
  const Vec3 move = point - p;
  if (move.norm() <= kSettled_m) {
    return {.point = p, .tool = held.tool, .settled = true};
  }
  if (point != held.point) {
    return {.point = point, .tool = held.tool};
  }
  const Candidate& first = near.candidates.candidate(rest.planes[0].candidate);
  const Vec3 lengthened = curve_.lengthen(move, p, held.tool, rest, planes, first.triangle);
  return {.point = p + lengthened, .tool = held.tool, .lengthened = lengthened != move};
}

}  // namespace tactus::rendering
