// What one tool feels of a scene, and remembers from tick to tick.
#pragma once

#include "rendering/state/state_archive.h"
#include "rendering/world/independent_contacts.h"
#include "rendering/world/proxy_touch.h"
#include "rendering/world/scene_objects.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

class ToolTouch {
 public:
  // Takes a radius >= 0, and starts over in a scene that may be another one.
  void start(const SceneObjects& scene, double tool_radius_m);

  // Forgets the contact: the next touch starts with the proxies at the tool.
  void reset() { placed_ = false; }

  // One tick, after scene.begin_tick(). Real time: no heap, bounded work. `path`, if given,
  // receives the shared proxy's moves.
  Touch touch(const SceneObjects& scene, const ToolState& tool, ProxyPath* path);

  // How far the proxy of an object was from the tool after the last touch, m.
  [[nodiscard]] double stretch_m(const SceneObjects& scene, std::uint32_t object) const {
    if (!placed_) {
      return 0.0;
    }
    return meets_proxy(scene[object]) ? proxy_.stretch_m() : independent_.stretch_m(scene, object);
  }

  // Most triangles ever kept near the tool, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const { return proxy_.peak_candidates(); }

  // What it remembers, to bytes or back; of the same scene.
  void transfer(StateArchive& archive, const SceneObjects& scene);

 private:
  void place(const SceneObjects& scene, const Vec3& p_W);
  void add_driven_power(Touch& touch, double tick_s) const;

  double radius_m_ = 0.0;
  ProxyTouch proxy_;
  IndependentContacts independent_;
  Vec3 last_proxy_W_ = Vec3::Zero();
  bool placed_ = false;
};

}  // namespace tactus::rendering
