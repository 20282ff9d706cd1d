// The shared proxy's part of a tick: from where it came to rest to what the hand feels.
#pragma once

#include <cstddef>
#include <span>

#include "rendering/contact/sphere_proxy.h"
#include "rendering/world/object.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

class ProxyTouch {
 public:
  // Takes another radius, >= 0; call place() afterwards.
  void set_tool_radius(double tool_radius_m) { proxy_.set_tool_radius(tool_radius_m); }

  // Starts over, out of contact, at p_W.
  void place(const Vec3& p_W) { proxy_.place(p_W); }

  // Moves the proxy for a tool that is finite, and gives the force of the surfaces that hold it:
  // F = K (proxy - tool) - B v, with K and B their mean weighted by how far each pushes. Bounded
  // work, no heap. `path`, if given, receives the moves.
  Touch touch(std::span<const Object> objects, const ToolState& tool, ProxyPath* path);

  // Most triangles ever kept near the tool, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const { return proxy_.peak_candidates(); }

 private:
  void set_force(std::span<const Object> objects, const ToolState& tool, const ProxyRest& rest,
                 Touch& touch) const;

  SphereProxy proxy_{0.0};
};

}  // namespace tactus::rendering
