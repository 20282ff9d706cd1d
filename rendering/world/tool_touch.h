// What one tool feels of a scenery, and remembers from tick to tick.
#pragma once

#include "rendering/state/state_archive.h"
#include "rendering/world/lone_touch.h"
#include "rendering/world/proxy_touch.h"
#include "rendering/world/scenery.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

class ToolTouch {
 public:
  // Takes a radius >= 0, and starts over in a scenery that may be another one.
  void start(const Scenery& scenery, double tool_radius_m);

  // Forgets the contact: the next touch starts with the proxies at the tool.
  void reset() { placed_ = false; }

  // One tick, after scenery.begin_tick(). Real time: no heap, bounded work. `path`, if given,
  // receives the shared proxy's moves.
  Touch touch(const Scenery& scenery, const ToolState& tool, ProxyPath* path);

  // How far the proxy of an object was from the tool after the last touch, m.
  [[nodiscard]] double stretch_m(const Scenery& scenery, std::uint32_t object) const {
    if (!placed_) {
      return 0.0;
    }
    return meets_proxy(scenery[object]) ? proxy_.stretch_m() : lone_.stretch_m(scenery, object);
  }

  // Most triangles ever kept near the tool, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const { return proxy_.peak_candidates(); }

  // What it remembers, to bytes or back; of the same scenery.
  void transfer(StateArchive& archive, const Scenery& scenery);

 private:
  void place(const Scenery& scenery, const Vec3& p_W);
  void add_driven_power(Touch& touch, double tick_s) const;

  double radius_m_ = 0.0;
  ProxyTouch proxy_;
  LoneTouch lone_;
  Vec3 last_proxy_W_ = Vec3::Zero();
  bool placed_ = false;
};

}  // namespace tactus::rendering
