// The touch of one tool with all objects, and its state from tick to tick. World has one for each
// tool.
#pragma once

#include "rendering/needle/needle_touch.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"
#include "rendering/touch.h"
#include "rendering/world/independent_contacts.h"
#include "rendering/world/proxy_touch.h"

namespace tactus::rendering {

// The shared proxy, the independent contacts and the needle of one tool.
class ToolTouch {
 public:
  // Sets the radius, >= 0, m, and the needle, and starts over in a scene that may be another one.
  void start(const SceneObjects& scene, double tool_radius_m, const NeedleScene& needle);

  // Forgets the contact: the next touch starts with the proxies at the tool.
  void reset() {
    placed_ = false;
    needle_.reset();
  }

  // Computes one tick, within `limit` cost units (tick_budget.h); call it after
  // scene.begin_tick(). Real time: no heap, bounded time. `watch` sees the moves
  // (rendering/contact/tick_watch.h).
  template <class Watch>
  Touch touch(const SceneObjects& scene, const ToolState& tool, std::size_t limit, Watch watch);

  // Returns the cost units that the last touch has spent.
  [[nodiscard]] std::size_t spent() const { return spent_; }

  // Returns the planes by which the tool holds bodies after the last touch.
  [[nodiscard]] const ToolGrips& grips() const { return proxy_.grips(); }

  // Returns the needle after the last touch.
  [[nodiscard]] const NeedleTouch& needle() const { return needle_; }

  // Returns how far the proxy of an object was from the tool after the last touch, m.
  [[nodiscard]] double stretch_m(const SceneObjects& scene, std::uint32_t object) const {
    if (!placed_ || is_tissue(scene[object])) {
      return 0.0;
    }
    return meets_proxy(scene[object]) ? proxy_.stretch_m() : independent_.stretch_m(scene, object);
  }

  // Returns true if the tool touches or overlaps the object.
  [[nodiscard]] bool touches(const SceneObjects& scene, std::uint32_t object) const {
    if (is_tissue(scene[object])) {
      return needle_.touches(object);
    }
    return placed_ && (meets_proxy(scene[object]) ? proxy_.touches(object)
                                                  : independent_.touches(scene, object));
  }
  // Returns true if the shared proxy touches nothing.
  [[nodiscard]] bool has_free_proxy() const { return !placed_ || proxy_.touches_nothing(); }

  // Begins with an object whose method has been changed; nothing may touch it. `met_proxy` says
  // that it met the shared proxy before. If it did or does so now, that proxy must be free, and
  // starts over where it is. Contacts of other objects go on as they are.
  void take_method(const SceneObjects& scene, std::uint32_t object, bool met_proxy);

  // Returns the largest number of candidates so far, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const { return proxy_.peak_candidates(); }

  // Saves the state to the archive, or restores it; the scene must be the same.
  void transfer(StateArchive& archive, const SceneObjects& scene);

 private:
  // Places all proxies at p_W, out of contact.
  void place(const SceneObjects& scene, const Vec3& p_W);
  // Adds the force of the needle.
  void add_needle(Touch& touch, const SceneObjects& scene, const ToolState& tool);
  // Adds the power that surfaces which deform give to the hand, W.
  void add_driven_power(Touch& touch, double tick_s) const;

  // The tool's radius, m.
  double radius_m_ = 0.0;
  ProxyTouch proxy_;
  IndependentContacts independent_;
  NeedleTouch needle_;
  // The proxy of the last touch (world frame, m), which an invalid tool gets again.
  Vec3 last_proxy_W_ = Vec3::Zero();
  // The cost units that the last touch has spent.
  std::size_t spent_ = 0;
  // False until the first valid tool, where the proxies start.
  bool placed_ = false;
};

}  // namespace tactus::rendering
