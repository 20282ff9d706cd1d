// The shared proxy's part of a tick: from where it came to rest to what the hand feels.
#pragma once

#include <cstddef>

#include "rendering/contact/sphere_proxy.h"
#include "rendering/world/scenery.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

class ProxyTouch {
 public:
  // Takes another radius, >= 0; call place() afterwards.
  void set_tool_radius(double tool_radius_m) { proxy_.set_tool_radius(tool_radius_m); }

  // Starts over, out of contact, at p_W.
  void place(const Vec3& p_W) { proxy_.place(p_W); }

  // First in every tick: objects that moved take the proxy along or push it. TouchFlags.
  std::uint32_t begin_tick(const Scenery& scenery) { return proxy_.begin_tick(scenery); }

  // Moves the proxy for a tool that is finite, and gives the force of the surfaces that hold it:
  // F = K (proxy - tool) - B v, with v relative to the surface, and K and B their mean weighted by
  // how far each pushes. Bounded work, no heap. `path`, if given, receives the moves.
  Touch touch(const Scenery& scenery, const ToolState& tool, ProxyPath* path);

  [[nodiscard]] const Vec3& position_W() const { return proxy_.position_W(); }

  // Most triangles ever kept near the tool, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const { return proxy_.peak_candidates(); }

 private:
  void set_force(const Scenery& scenery, const ToolState& tool, const ProxyRest& rest,
                 Touch& touch) const;

  SphereProxy proxy_{0.0};
};

}  // namespace tactus::rendering
