#include "rendering/contact/straight_escape.h"

#include "rendering/contact/candidate_sweep.h"

namespace tactus::rendering {

void sweep_to_tool(const NearbySurfaces& near, const Vec3& h_W, ProxyState& state) {
  Vec3& p = state.p_W;
  const Vec3 move = h_W - p;
  const double length = move.norm();
  if (length <= 0.0) {
    state.friction = FrictionState::free;
    return;
  }
  const Sweep sweep{.from = p, .direction = move / length};
  const FirstHit hit = sweep_beyond_candidates(near, sweep, length, kMaxCarryBudget);
  if (hit.object != kNoObject) {
    state.last_contact = {.object = hit.object, .triangle = hit.triangle};
  }
  if (hit.travel_m > 0.0) {
    p = hit.travel_m >= length ? h_W : Vec3{p + hit.travel_m * sweep.direction};
    near.candidates.move_to(p);
  }
}

void escape_overfull_planes(const NearbySurfaces& near, const Vec3& h_W, const MovingProxy& proxy) {
  auto& [state, planes, rest] = proxy;
  if ((rest.flags & kTouchPlanesOverflow) == 0 || rest.sub_goals > 0) {
    return;
  }
  sweep_to_tool(near, h_W, state);
  if (state.p_W == h_W) {
    rest.plane_count = 0;
    rest.normal_W = Vec3::Zero();
    state.friction = FrictionState::free;
  }
}

}  // namespace tactus::rendering
