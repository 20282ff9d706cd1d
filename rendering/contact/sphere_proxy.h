// The sphere proxy: the god-object of Zilles and Salisbury (IROS 1995) with a radius, after
// Ruspini, Kolarov and Khatib ("The haptic display of complex graphical environments", SIGGRAPH
// 1997). With radius 0 it is the god-object. proxy_tick.cpp describes one tick.
//
// ProxyTouch (rendering/world/proxy_touch.h) owns one for each tool and calls, in every tick:
// begin_tick, begin_friction, advance, perhaps advance_again, look_ahead.
#pragma once

#include <cstdint>

#include "rendering/contact/candidate_set.h"
#include "rendering/contact/contact_planes.h"
#include "rendering/contact/proxy_rest.h"
#include "rendering/contact/proxy_state.h"
#include "rendering/contact/sphere_sweep.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// The proxy of one tool, shared by all objects of the methods sphere_proxy and god_object. World
// frame.
class SphereProxy {
 public:
  explicit SphereProxy(double tool_radius_m) : margins_(tool_radius_m) {}

  // Sets the tool's radius, >= 0, m; call place() afterwards.
  void set_tool_radius(double tool_radius_m) { margins_ = ContactMargins(tool_radius_m); }

  // Places the proxy at p_W (world frame, m), out of contact, and resets the rest of its state. It
  // searches no triangle.
  void place(const Vec3& p_W);

  // Begins a tick that may spend `limit` cost units (tick_budget.h). Call it first in every tick.
  void start_tick_budget(std::size_t limit) { candidate_set_.start_tick_budget(limit); }

  // Moves the proxy with the objects that moved since the last tick. Call it in every tick, when
  // the objects are at their new places. Returns TouchFlags. Bounded time, no heap.
  std::uint32_t begin_tick(const SceneObjects& scene);

  // Sets where the tool was in the last tick and is now (world frame, m), and the duration of that
  // step (s), which drive the friction models. Call it after begin_tick.
  void begin_friction(const Vec3& from_W, const Vec3& to_W, double tick_s);

  // Moves the proxy as near to the tool position h_W (world frame, m, finite) as surfaces and
  // friction allow. `watch` sees the moves (tick_watch.h). Bounded time, no heap.
  template <class Watch>
  ProxyRest advance(const SceneObjects& scene, const Vec3& h_W, Watch watch);

  // Repeats the last advance from the same start toward another goal. Friction takes the state of
  // the repetition only. The cost of both counts for the tick.
  template <class Watch>
  ProxyRest advance_again(const SceneObjects& scene, const Vec3& h_W, Watch watch);

  // Gathers candidates for the next tick if there is budget left. Call it last in a tick.
  void look_ahead(const SceneObjects& scene) {
    candidate_set_.look_ahead(scene, margins_, state_.p_W,
                              state_.p_W + kFarther * (state_.p_W - start_.p_W));
  }

  // Returns the cost units that this tick has spent.
  [[nodiscard]] std::size_t spent() const { return candidate_set_.budget().spent(); }

  // Returns true if the tick's budget allows one more advance_again.
  [[nodiscard]] bool can_advance_again() const { return candidate_set_.budget().can_repeat(); }

  // Sets the friction factors of the next advances. By default all factors are 1 and the depth is
  // 0.
  void set_friction_factors(const FrictionFactors& factors) { factors_ = factors; }

  // Returns the proxy's centre; world frame, m.
  [[nodiscard]] const Vec3& position_W() const { return state_.p_W; }
  // Returns the memory of the surfaces that the last advance reached without the hand's work.
  [[nodiscard]] const UnpressedDepths& unpressed() const { return state_.unpressed; }
  // Returns the friction state after the last advance.
  [[nodiscard]] FrictionState friction() const { return state_.friction; }
  // Returns true if no surface held the proxy in the last advance.
  [[nodiscard]] bool is_free() const { return state_.last_contact.object == kNoObject; }
  // Returns true if the object held the proxy in the last advance, or is left out because the proxy
  // overlaps it.
  [[nodiscard]] bool touches(std::uint32_t object) const;
  // Returns the largest number of candidates so far, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const { return candidate_set_.peak(); }

  // Saves the state to the archive, or restores it; the scene must be the same.
  void transfer(StateArchive& archive, const SceneObjects& scene);

 private:
  // Estimates the next tick's move as this multiple of the current one.
  static constexpr double kFarther = 1.5;

  // Moves the proxy and finds the contact of the tick.
  template <class Watch>
  ProxyRest approach(const SceneObjects& scene, const Vec3& h_W, Watch watch);
  void update_left_out(const SceneObjects& scene);
  void turn_with_contact(const SceneObjects& scene);

  // The contact margins of the tool's radius.
  ContactMargins margins_;
  ProxyState state_;
  // The state at the start of the last advance, from which a repetition starts.
  ProxyState start_;
  // The displacement by objects that moved, since the last begin_friction; world frame, m.
  Vec3 carried_W_ = Vec3::Zero();
  // The tool's motion in this tick; world frame, m.
  Vec3 tool_step_W_ = Vec3::Zero();
  // The rotation of the objects that carried it, since then.
  Mat3 turned_W_ = Mat3::Identity();
  FrictionFactors factors_;
  // True until the first tick after place(): objects that overlap the proxy then are left out.
  bool just_placed_ = true;
  CandidateSet candidate_set_;
  // The planes of the last sub-goal. They live longer than a tick only while a gathering is begun.
  ContactPlanes planes_;
};

}  // namespace tactus::rendering
