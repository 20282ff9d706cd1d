// The virtual world that one tool touches.
#pragma once

#include <span>

#include "rendering/contact/sphere_proxy.h"
#include "rendering/world/object.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

struct WorldConfig {
  double tool_radius_m = 0.0;  // >= 0; 0 is the god-object point
};

// Lives in static storage: half a megabyte of fixed arrays, no heap. Not thread-safe; one thread
// owns it.
class World {
 public:
  World() = default;

  // Takes a scene and starts over; the views must stay alive and unchanged. False, and an empty
  // world, if there are more than kMaxObjects objects, an object without triangles or hierarchy, or
  // a negative radius.
  bool set_scene(std::span<const Object> objects, const WorldConfig& config);

  // Forgets the contact: the next touch starts with the proxy at the tool.
  void reset();

  // One tick: moves the proxy and gives the force on the hand, F = K (proxy - tool) - B v in
  // contact and zero otherwise. With several surfaces in contact, K and B are their mean weighted
  // by how far each pushes. The damper acts on the whole velocity, so a hand that leaves quickly
  // can feel a pull of at most B v. Real time: no heap, no exceptions, bounded work; trouble is in
  // Touch::flags. `path`, if given, receives the proxy's moves.
  Touch touch(const ToolState& tool, ProxyPath* path = nullptr);

  // Most triangles ever kept near the tool, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const { return proxy_.peak_candidates(); }

 private:
  void add_force(const ToolState& tool, const ProxyRest& rest, Touch& touch) const;

  std::span<const Object> objects_;
  SphereProxy proxy_{0.0};
  bool placed_ = false;
};

}  // namespace tactus::rendering
