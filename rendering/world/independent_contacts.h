// The independent contacts of one tool: potential fields, feature walks, implicit surfaces and the
// textbook's methods. Each gives its own force, apart from the shared proxy. ToolTouch adds them to
// the shared proxy's touch.
#pragma once

#include <array>
#include <cstdint>

#include "rendering/contact/feature_walk.h"
#include "rendering/contact/implicit_tracking.h"
#include "rendering/contact/textbook/plain_tracking.h"
#include "rendering/contact/textbook/textbook_proxy.h"
#include "rendering/limits.h"
#include "rendering/material/force_shading.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"
#include "rendering/tick_budget.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// Every contact is computed in its object's own frame: an object that moves carries its proxy
// along, and meets every tool that it sweeps over. An object whose box is not near the tool sleeps
// and costs next to nothing. `k` counts SceneObjects::independent_objects() throughout.
class IndependentContacts {
 public:
  // Starts over, out of contact, at p_W.
  void place(const SceneObjects& scene, const Vec3& p_W, double tool_radius_m);

  // Adds the forces to `touch`, which holds the shared proxy's result, and reports the object with
  // the largest force of all, within `limit` cost units (tick_budget.h). The tool must be
  // finite. Bounded time, no heap. `watch` sees the moves
  // (rendering/contact/tick_watch.h).
  template <class Watch>
  void add_to(Touch& touch, const SceneObjects& scene, const ToolState& tool, std::size_t limit,
              Watch watch);

  // Returns true if the tool's motion to p_W (world frame, m) meets an object's box, or if a
  // contact is left from the last tick.
  [[nodiscard]] bool any_near(const SceneObjects& scene, const Vec3& p_W) const;

  // Returns the cost units that the last add_to has spent.
  [[nodiscard]] std::size_t spent() const { return budget_.spent(); }

  // Holds the contacts in a tick without a valid tool. Call it instead of add_to.
  void hold(const SceneObjects& scene);

  // Returns how far the proxy of an object was from the tool after the last touch, m.
  [[nodiscard]] double stretch_m(const SceneObjects& scene, std::uint32_t object) const;

  // Returns true if the tool touched an object in the last tick, or began in its field.
  [[nodiscard]] bool touches(const SceneObjects& scene, std::uint32_t object) const;

  // Begin and end with an object that has just joined or left SceneObjects::independent_objects(),
  // and start over with one that has another method; out of contact, where the tool was in the last
  // tick. The contacts of all others go on as they are.
  void insert(const SceneObjects& scene, std::uint32_t object);
  void remove(const SceneObjects& scene, std::uint32_t object);
  void restart(const SceneObjects& scene, std::uint32_t object);

  // Saves the state to the archive, or restores it; the scene must be the same.
  void transfer(StateArchive& archive, const SceneObjects& scene);

 private:
  // The proxy of one object, by its method: of an implicit surface, of a feature walk, and of the
  // textbook's methods on meshes and on formulas. A potential field has none.
  struct Proxies {
    ImplicitTracker tracker;
    FeatureWalker walker;
    TextbookProxy textbook;
    PlainTracker plain_tracker;

    // Starts over, out of contact, at p_O: the object's frame, m.
    void place(const Vec3& p_O);
    // Returns the proxy after the last tick; the object's frame, m.
    [[nodiscard]] const Vec3& position_O(ContactMethod method) const;
  };

  // The state of shading and textures of one object, in its frame.
  struct DetailState {
    ForceShading shading;
    // The point that was touched in the last tick, if any; m.
    Vec3 point_O = Vec3::Zero();
    bool touched = false;
    // The factor of the friction coefficients that the detail gave in the last tick.
    double friction_factor = 1.0;
  };

  // One object with its current material.
  struct IndependentObject {
    std::size_t k;
    const Object& object;
    const Material& material;
    // The distance that the tool has moved since the last tick, seen from the object, m.
    double moved_m;
  };

  // Starts contact `k` over, out of contact, at the last tool.
  void place_one(const SceneObjects& scene, std::size_t k);
  // Returns how far the proxy of contact `k` is from the tool at tool_O (the object's frame), m.
  [[nodiscard]] double stretch_of(std::size_t k, const Object& object, const Vec3& tool_O) const;
  // Computes the contact of one object without shading, in its own frame.
  template <class Watch>
  Touch rest_in_frame(const IndependentObject& independent, const Vec3& goal_O, Watch watch);
  // Computes a contact by one of the textbook's methods on meshes.
  template <class Watch>
  Touch touch_by_textbook(const IndependentObject& independent, const Vec3& tool_O, Watch watch);
  // Computes a potential field.
  Touch touch_of_field(std::size_t k, const Object& object, const Vec3& tool_O);
  // Applies the object's detail to the touch, and prepares the shift of the next tick's goal.
  void shade_in_frame(const IndependentObject& independent, const ToolState& tool_O, Touch& touch);
  // Computes the contact of one object with its detail, in its own frame.
  template <class Watch>
  Touch touch_in_frame(const IndependentObject& independent, const ToolState& tool_O, Watch watch);
  // Returns true if the tool's motion in this tick enters the object's box.
  [[nodiscard]] bool is_near(const Mover* mover, const Object& object, const Vec3& p_W) const;
  // Returns the number of contacts to compute for a tool at p_W.
  [[nodiscard]] std::size_t count_near(const SceneObjects& scene, const Vec3& p_W) const;
  // Begins a contact that was asleep.
  void wake(std::size_t k, const Mover* mover);

  // The tool: its radius, its last position (world frame) and the length of its last step; m.
  double tool_radius_m_ = 0.0;
  Vec3 last_tool_W_ = Vec3::Zero();
  double tool_step_m_ = 0.0;
  // The budget of all contacts in this tick, and the share of the one that is computed, cost units.
  TickBudget budget_;
  std::size_t share_ = 0;
  // The objects that are near or in contact; the others were skipped in the last tick.
  std::array<bool, kMaxIndependentObjects> awake_{};
  // The proxies, and the detail; each object uses what its method needs.
  std::array<Proxies, kMaxIndependentObjects> proxies_;
  std::array<DetailState, kMaxIndependentObjects> details_;
  // Potential fields that have overlapped the tool in every tick since it began there.
  std::array<bool, kMaxIndependentObjects> left_out_{};
};

}  // namespace tactus::rendering
