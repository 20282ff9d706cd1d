// Computes the shared proxy's part of a touch: moves the proxy, applies force shading and textures,
// and gives the force. ToolTouch has one for its tool.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/contact/corner_spring.h"
#include "rendering/contact/sphere_proxy.h"
#include "rendering/material/force_shading.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"
#include "rendering/touch.h"
#include "rendering/world/tool_grip.h"

namespace tactus::rendering {

// The shared proxy of one tool with its detail. World frame.
class ProxyTouch {
 public:
  // Takes another radius, >= 0; call place() afterwards.
  void set_tool_radius(double tool_radius_m);

  // Starts over, out of contact, at p_W.
  void place(const Vec3& p_W);

  // Begins a tick that may spend `limit` cost units. Call it first in every tick.
  void start_tick_budget(std::size_t limit) { proxy_.start_tick_budget(limit); }
  // Moves the proxy with the objects that moved. Call it in every tick. Returns TouchFlags.
  std::uint32_t begin_tick(const SceneObjects& scene) { return proxy_.begin_tick(scene); }
  // Returns the cost units that this tick has spent.
  [[nodiscard]] std::size_t spent() const { return proxy_.spent(); }

  // Moves the proxy for a finite tool, and returns the force of the surfaces that hold it: F = K
  // (proxy - tool) - B v, without a pull into the surface. v is relative to the surface. Surfaces
  // of different stiffness act as one spring (corner_spring.h); B v is a mean weighted by the
  // pressures. A surface with detail shifts the proxy so that the force is along its shading
  // normal, and its bumps shorten the stretch. This takes up to kMostPasses advances of the proxy,
  // within the budget of one tick. Bounded time, no heap. `watch` sees the moves
  // (rendering/contact/tick_watch.h).
  template <class Watch>
  Touch touch(const SceneObjects& scene, const ToolState& tool, Watch watch);

  // Returns the planes of bodies in the last touch.
  [[nodiscard]] const ToolGrips& grips() const { return grips_; }
  // Forgets them, in a tick without a touch.
  void let_go() { grips_.count = 0; }

  // Returns the proxy's centre, m.
  [[nodiscard]] const Vec3& position_W() const { return proxy_.position_W(); }

  // Returns how far the proxy was from the tool after the last touch, m.
  [[nodiscard]] double stretch_m() const { return (position_W() - last_tool_W_).norm(); }

  // Returns true if nothing held the proxy in the last touch, so that it is where the tool is.
  [[nodiscard]] bool touches_nothing() const { return proxy_.is_free() && stretch_m() == 0.0; }
  // Returns true if the object held the proxy in the last touch, or the proxy overlaps it.
  [[nodiscard]] bool touches(std::uint32_t object) const { return proxy_.touches(object); }

  // Returns the largest number of candidates so far, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const { return proxy_.peak_candidates(); }

  // Saves the state to the archive, or restores it; the scene must be the same.
  void transfer(StateArchive& archive, const SceneObjects& scene);

 private:
  // The surfaces that hold the proxy, blended. The sums are weighted by the pressures, m.
  struct BlendedSurface {
    // True if one of the surfaces has detail, and if one of them has interpolated normals.
    bool detailed = false;
    bool interpolated = false;
    // The sum of the weights, m.
    double pressure_m = 0.0;
    // The spring of the stiffnesses with the detail's factors, and, if there is detail, without
    // them.
    CornerSpring spring;
    CornerSpring plain_spring;
    // The sum of B times the velocity relative to the surface, N m.
    Vec3 damping_W = Vec3::Zero();
    // The sum of the surfaces' own velocities, m^2/s.
    Vec3 surface_v_W = Vec3::Zero();
    // The depth of the tool below the planes, m.
    double depth_m = 0.0;
    // The depth of the tool below the bumps of the planes, m, >= 0.
    double effective_depth_m = 0.0;
    // The lean that the detail asks for (ShadedRest), scaled by the share of the effective depth.
    Vec3 lean = Vec3::Zero();
    // The friction factors of the surfaces with detail.
    FrictionFactors friction;
  };
  // A point of a surface with detail that is touched, in the object's frame, m.
  struct ContactPoint {
    std::uint32_t object = 0;
    Vec3 point_O = Vec3::Zero();
  };
  struct ContactPoints {
    std::array<ContactPoint, 3> points{};
    std::size_t count = 0;
  };

  // Repeats the advance with a shifted goal until the shift settles, the passes or the budget end.
  template <class Watch>
  void shade(const SceneObjects& scene, const ToolState& tool, Watch watch, ProxyRest& rest,
             BlendedSurface& blended);
  // Blends the surfaces; first it moves the proxy back if a shifted goal took it off them.
  template <class Watch>
  BlendedSurface return_to_surface(const SceneObjects& scene, const ToolState& tool, Watch watch,
                                   ProxyRest& rest);
  // Gives the proxy the friction factors of its next advance.
  void set_friction(const FrictionFactors& of_surfaces);
  // Sums up the surfaces that hold the proxy, weighted by the pressures.
  BlendedSurface blend_surfaces(const SceneObjects& scene, const ToolState& tool,
                                const ProxyRest& rest);
  // Returns the detail at a contact; world frame.
  Detail detail_of(const SceneObjects& scene, const ContactPlane& plane);
  // Returns the travel of a contact point since the last tick, m.
  [[nodiscard]] double travel_to(const ContactPoint& here) const;
  // Returns the proxy's friction state; free if no surface that holds it has friction.
  [[nodiscard]] FrictionState friction_state(const SceneObjects& scene,
                                             const ProxyRest& rest) const;
  // Write the force, the contact and the parts of the force to the touch.
  void set_force(const SceneObjects& scene, const ToolState& tool, const ProxyRest& rest,
                 const BlendedSurface& blended, Touch& touch);
  // Divides the force of a touch among its planes and keeps those of bodies. `spring_force_W` is
  // the force without the damping.
  void set_grips(const SceneObjects& scene, const ToolState& tool, const ProxyRest& rest,
                 const Vec3& spring_force_W, const Touch& touch);
  static void set_parts(const Vec3& stretch, const BlendedSurface& blended, Touch& touch);

  SphereProxy proxy_{0.0};
  ToolGrips grips_;
  ForceShading shading_;
  // The friction factors of the surfaces where the proxy is.
  FrictionFactors friction_;
  // The points of surfaces with detail at the end of the last tick, and in this pass.
  ContactPoints before_;
  ContactPoints here_;  // in this pass
  // The tool of the last touch (world frame), and the length of its step; m.
  Vec3 last_tool_W_ = Vec3::Zero();
  double tool_step_m_ = 0.0;
  // The travel of the contact in this tick, from its first pass; m.
  double travel_m_ = 0.0;
  // True in the first pass of a tick.
  bool first_pass_ = true;
  // True if some surface in the last tick had detail.
  bool detailed_ = false;
};

}  // namespace tactus::rendering
