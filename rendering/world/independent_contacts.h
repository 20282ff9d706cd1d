// The objects that one tool touches apart from the shared proxy: potential fields, feature walks
// and implicit surfaces. Each pushes for itself.
#pragma once

#include <array>
#include <cstdint>

#include "rendering/contact/feature_walk.h"
#include "rendering/contact/implicit_tracking.h"
#include "rendering/limits.h"
#include "rendering/material/force_shading.h"
#include "rendering/state/state_archive.h"
#include "rendering/world/scene_objects.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

// Works in each object's own frame, so an object that moves takes its proxy along and sweeps over
// no tool without meeting it. An object whose box the tool does not come near costs next to
// nothing.
class IndependentContacts {
 public:
  // Starts over, out of contact, at p_W.
  void place(const SceneObjects& scene, const Vec3& p_W, double tool_radius_m);

  // Adds the forces to `touch`, which is of the shared proxy, and tells of the object that pushes
  // hardest of all. The tool is finite. Bounded work, no heap.
  void add_to(Touch& touch, const SceneObjects& scene, const ToolState& tool);

  // Instead of add_to in a tick without a valid tool.
  void hold(const SceneObjects& scene);

  // How far the proxy of one of them was from the tool after the last touch, m.
  [[nodiscard]] double stretch_m(const SceneObjects& scene, std::uint32_t object) const;

  // What it remembers, to bytes or back; of the same scene.
  void transfer(StateArchive& archive, const SceneObjects& scene);

 private:
  // What shading and textures remember of one object, in its frame.
  struct DetailState {
    ForceShading shading;
    Vec3 point_O = Vec3::Zero();  // touched in the last tick
    bool touched = false;
    double friction_factor = 1.0;
  };

  // One of them, and what it feels like now.
  struct IndependentObject {
    std::size_t k;
    const Object& object;
    const Material& material;
  };

  // Of one object, everything in its own frame.
  Touch rest_in_frame(const IndependentObject& independent, const Vec3& goal_O);
  Touch touch_of_field(std::size_t k, const Object& object, const Vec3& tool_O);
  [[nodiscard]] const Vec3& last_proxy_O(std::size_t k, const Object& object) const;
  void shade_in_frame(const IndependentObject& independent, const ToolState& tool_O, Touch& touch);
  Touch touch_in_frame(const IndependentObject& independent, const ToolState& tool_O);
  [[nodiscard]] bool is_near(const Mover* mover, const Object& object, const Vec3& p_W) const;
  void wake(std::size_t k, const Mover* mover);

  double tool_radius_m_ = 0.0;
  Vec3 last_tool_W_ = Vec3::Zero();
  double tool_step_m_ = 0.0;
  std::array<bool, kMaxIndependentObjects> awake_{};  // of SceneObjects::independent_objects()
  std::array<ImplicitTracker, kMaxIndependentObjects> trackers_;
  std::array<FeatureWalker, kMaxIndependentObjects> walkers_;
  std::array<DetailState, kMaxIndependentObjects> details_;
  // Potential fields that have overlapped the tool in every tick since it began there.
  std::array<bool, kMaxIndependentObjects> left_out_{};
};

}  // namespace tactus::rendering
