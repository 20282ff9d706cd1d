// The virtual world that one tool touches.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/contact/feature_walk.h"
#include "rendering/contact/implicit_tracking.h"
#include "rendering/limits.h"
#include "rendering/world/object.h"
#include "rendering/world/proxy_touch.h"
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
  // world, if there are more than kMaxObjects objects, a negative radius, or an object whose
  // surface is not valid or does not go with its contact method (see ContactMethod).
  bool set_scene(std::span<const Object> objects, const WorldConfig& config);

  // Forgets the contact: the next touch starts with the proxy at the tool.
  void reset();

  // One tick: moves the proxies and gives the force on the hand, F = K (proxy - tool) - B v in
  // contact and zero otherwise. Objects of the methods sphere_proxy and god_object share one proxy;
  // with several of them in contact, K and B are their mean weighted by how far each pushes. Every
  // other object pushes for itself, and the forces add up; the rest of the touch is then told of
  // the one that pushes hardest. The damper acts on the whole velocity, so a hand that leaves
  // quickly can feel a pull of at most B v. Real time: no heap, no exceptions, bounded work;
  // trouble is in Touch::flags. `path`, if given, receives the shared proxy's moves.
  Touch touch(const ToolState& tool, ProxyPath* path = nullptr);

  // Most triangles ever kept near the tool, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const { return proxy_.peak_candidates(); }

 private:
  void place(const Vec3& p_W);
  // Of one object that is not met by the shared proxy.
  Touch touch_alone(std::uint32_t number, const ToolState& tool);
  Touch touch_implicit(std::uint32_t number, const ToolState& tool);
  Touch touch_features(std::uint32_t number, const ToolState& tool);
  [[nodiscard]] Touch touch_field(std::uint32_t number, const ToolState& tool) const;

  std::span<const Object> objects_;
  double tool_radius_m_ = 0.0;
  Vec3 last_proxy_ = Vec3::Zero();
  ProxyTouch proxy_;
  bool any_proxy_ = false;                             // some object is met by it
  std::array<ImplicitTracker, kMaxObjects> trackers_;  // of the objects with their numbers
  std::array<FeatureWalker, kMaxObjects> walkers_;     // the same
  bool placed_ = false;
};

}  // namespace tactus::rendering
