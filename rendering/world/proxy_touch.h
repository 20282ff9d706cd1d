// Computes the shared proxy's part of a touch: moves the proxy, applies force shading and textures,
// and gives the force.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/contact/sphere_proxy.h"
#include "rendering/material/force_shading.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"
#include "rendering/touch.h"

namespace tactus::rendering {

class ProxyTouch {
 public:
  // Takes another radius, >= 0; call place() afterwards.
  void set_tool_radius(double tool_radius_m);

  // Starts over, out of contact, at p_W.
  void place(const Vec3& p_W);

  // Moves the proxy with the objects that moved. Call it first in every tick. Returns TouchFlags.
  std::uint32_t begin_tick(const SceneObjects& scene) { return proxy_.begin_tick(scene); }

  // Moves the proxy for a finite tool, and returns the force of the surfaces that hold it: F = K
  // (proxy - tool) - B v. v is relative to the surface; K and B are means weighted by the
  // pressures. A surface with detail shifts the proxy so that the force is along its shading
  // normal, and its bumps shorten the stretch. This takes up to kMostPasses advances of the proxy,
  // within the budget of one tick. Bounded time, no heap. `path` receives the moves if it is not
  // null.
  Touch touch(const SceneObjects& scene, const ToolState& tool, ProxyPath* path);

  [[nodiscard]] const Vec3& position_W() const { return proxy_.position_W(); }

  // Returns how far the proxy was from the tool after the last touch, m.
  [[nodiscard]] double stretch_m() const { return (position_W() - last_tool_W_).norm(); }

  // Returns the largest number of candidates so far, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const { return proxy_.peak_candidates(); }

  // Saves the state to the archive, or restores it; the scene must be the same.
  void transfer(StateArchive& archive, const SceneObjects& scene);

 private:
  // The surfaces that hold the proxy, blended. The sums are weighted by the pressures.
  struct BlendedSurface {
    bool detailed = false;
    bool interpolated = false;
    double pressure_m = 0.0;          // the sum of the weights
    double stiffness = 0.0;           // sum, N
    double plain_stiffness = 0.0;     // sum, N: without the detail
    Vec3 damping_W = Vec3::Zero();    // sum, N m
    Vec3 surface_v_W = Vec3::Zero();  // sum, m^2/s
    double depth_m = 0.0;             // of the tool below the planes
    double effective_depth_m = 0.0;   // below their bumps; >= 0
    Vec3 lean = Vec3::Zero();         // see ShadedRest
    FrictionFactors friction;
  };
  struct ContactPoint {
    std::uint32_t object = 0;
    Vec3 point_O = Vec3::Zero();
  };
  struct ContactPoints {
    std::array<ContactPoint, 3> points{};
    std::size_t count = 0;
  };

  void shade(const SceneObjects& scene, const ToolState& tool, ProxyPath* path, ProxyRest& rest,
             BlendedSurface& blended);
  BlendedSurface return_to_surface(const SceneObjects& scene, const ToolState& tool,
                                   ProxyPath* path, ProxyRest& rest);
  void set_friction(const FrictionFactors& of_surfaces);
  BlendedSurface blend_surfaces(const SceneObjects& scene, const ToolState& tool,
                                const ProxyRest& rest);
  Detail detail_of(const SceneObjects& scene, const ContactPlane& plane);
  [[nodiscard]] double travel_to(const ContactPoint& here) const;
  void set_force(const ToolState& tool, const ProxyRest& rest, const BlendedSurface& blended,
                 Touch& touch) const;
  static void set_parts(const Vec3& stretch, const BlendedSurface& blended, Touch& touch);

  SphereProxy proxy_{0.0};
  ForceShading shading_;
  FrictionFactors friction_;  // of the surfaces where the proxy is
  ContactPoints before_;      // of surfaces with detail, at the end of the last tick
  ContactPoints here_;        // in this pass
  Vec3 last_tool_W_ = Vec3::Zero();
  double tool_step_m_ = 0.0;
  double travel_m_ = 0.0;  // of the contact in this tick
  bool first_pass_ = true;
  bool detailed_ = false;  // some surface in the last tick was
};

}  // namespace tactus::rendering
