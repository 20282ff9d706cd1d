#include "rendering/contact/sphere_proxy.h"

#include <algorithm>

#include "rendering/contact/active_constraints.h"
#include "rendering/contact/carry_along.h"
#include "rendering/contact/proxy_tick.h"
#include "rendering/contact/tick_watcher.h"

namespace tactus::rendering {

void SphereProxy::place(const Vec3& p_W) {
  state_ = {.p_W = p_W};
  carried_W_ = Vec3::Zero();
  turned_W_ = Mat3::Identity();
  tool_step_W_ = Vec3::Zero();
  planes_.clear();
  just_placed_ = true;
  candidate_set_.start_over();
  candidate_set_.move_to(p_W);
}

bool SphereProxy::touches(std::uint32_t object) const {
  return state_.last_contact.object == object ||
         std::ranges::find(state_.held_by.surfaces, object, &HeldBy::Surface::object) !=
             state_.held_by.surfaces.end() ||
         candidate_set_.left_out().has(object);
}

// The candidates are checked first, with the objects at their new places: those near a moved object
// are not valid any more. Then the proxy is carried.
std::uint32_t SphereProxy::begin_tick(const SceneObjects& scene) {
  candidate_set_.begin_tick(scene);
  if (!scene.anything_moved()) {
    return kTouchClean;
  }
  const Carried carried =
      carry_along(scene, margins_, state_.p_W, state_.last_contact, candidate_set_.left_out());
  candidate_set_.budget().spend(carried.spent);
  carried_W_ += carried.p_W - state_.p_W;
  turn_with_contact(scene);
  if (carried.p_W != state_.p_W) {
    state_.p_W = carried.p_W;
    candidate_set_.move_to(state_.p_W);
  }
  return carried.flags;
}

// Friction belongs to the surface: the bristles turn with the object that carries the proxy.
void SphereProxy::turn_with_contact(const SceneObjects& scene) {
  const std::uint32_t object = state_.last_contact.object;
  const Mover* const mover = object == kNoObject ? nullptr : scene.mover_of(object);
  if (mover == nullptr || mover->X_WO.rotation == mover->X_WO_before.rotation) {
    return;
  }
  const Mat3 turn_W = mover->X_WO.rotation * mover->X_WO_before.rotation.transpose();
  state_.models.turn_by(turn_W);
  turned_W_ = turn_W * turned_W_;
}

// A proxy that is carried does not slide over the object that carries it, so friction sees the
// tool's step without the motion of the object. That motion is the one at the tool, which the
// object would carry along as it carries the proxy: seen from the object, the stretch between the
// two does not turn.
void SphereProxy::begin_friction(const Vec3& from_W, const Vec3& to_W, double tick_s) {
  const Vec3 stretch_W = from_W - (state_.p_W - carried_W_);
  const Vec3 turned_W = turned_W_ * stretch_W - stretch_W;
  tool_step_W_ = to_W - from_W;
  state_.models.begin_tick(tool_step_W_ - carried_W_ - turned_W, tick_s);
  carried_W_ = Vec3::Zero();
  turned_W_ = Mat3::Identity();
}

template <class Watch>
ProxyRest SphereProxy::advance(const SceneObjects& scene, const Vec3& h_W, Watch watch) {
  start_ = state_;
  update_left_out(scene);
  return approach(scene, h_W, watch);
}

// The candidates stay, with the tangents of their measurements, so a repetition costs less than the
// first advance; its distances are measured again.
template <class Watch>
ProxyRest SphereProxy::advance_again(const SceneObjects& scene, const Vec3& h_W, Watch watch) {
  state_ = start_;
  candidate_set_.move_to(state_.p_W);
  return approach(scene, h_W, watch);
}

template <class Watch>
ProxyRest SphereProxy::approach(const SceneObjects& scene, const Vec3& h_W, Watch watch) {
  const NearbySurfaces near{.scene = scene, .margins = margins_, .candidates = candidate_set_};
  ProxyRest rest;
  run_sub_goals({.near = near, .factors = factors_, .h_W = h_W},
                {.state = state_, .planes = planes_, .rest = rest}, watch);
  // A tick that ended in the middle of its path may have no plane, yet the surface still pushes the
  // hand.
  constexpr std::uint32_t kUnfinished = kTouchIterationsExhausted | kTouchCandidatesOverflow;
  if (rest.plane_count == 0 && (rest.flags & kUnfinished) != 0) {
    keep_last_contact(scene, state_.last_contact, state_.p_W, h_W, rest);
  }
  state_.last_contact = hardest_contact(rest);
  state_.unpressed.end_tick(scene, rest, {.p_W = state_.p_W, .tool_step_W = tool_step_W_});
  state_.held_by = holding_surfaces(rest);
  rest.flags |= candidate_set_.left_out().any() ? kTouchOverlap : kTouchClean;
  return rest;
}

// Leaves out the objects that overlap the sphere when it is placed, and takes back objects once
// the sphere is clear of them.
void SphereProxy::update_left_out(const SceneObjects& scene) {
  // A placed proxy overlaps what is nearer than the margin's `inner_m` by this, m.
  constexpr double kNoOverlap_m = 0.5e-6;  // within the contact margin
  LeftOut& left_out = candidate_set_.left_out();
  bool changed = false;
  if (just_placed_) {
    changed = left_out.add_overlapped(scene, margins_, state_.p_W, kNoOverlap_m);
    just_placed_ = false;
  } else if (left_out.any()) {
    changed = left_out.take_back(scene, margins_, state_.p_W);
  }
  if (changed) {
    candidate_set_.clear();
  }
}

template ProxyRest SphereProxy::advance(const SceneObjects&, const Vec3&, Unwatched);
template ProxyRest SphereProxy::advance(const SceneObjects&, const Vec3&, Watched);
template ProxyRest SphereProxy::advance_again(const SceneObjects&, const Vec3&, Unwatched);
template ProxyRest SphereProxy::advance_again(const SceneObjects&, const Vec3&, Watched);

}  // namespace tactus::rendering
