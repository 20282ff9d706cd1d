// The virtual world that one tool touches, or several.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/effects/effect.h"
#include "rendering/limits.h"
#include "rendering/state/state_archive.h"
#include "rendering/world/effect_touch.h"
#include "rendering/world/object.h"
#include "rendering/world/scene_objects.h"
#include "rendering/world/tool_touch.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

struct WorldConfig {
  double tool_radius_m = 0.0;  // 0 to kMaxToolRadius_m; 0 is the god-object point
  std::size_t tool_count = 1;  // 1 to kMaxTools
  // At most kMaxEffects, each felt by every tool; kept alive and unchanged by the caller.
  std::span<const Effect> effects;
};

// Lives in static storage: a few megabytes of fixed arrays, no heap. Not thread-safe; one thread
// owns it.
class World {
 public:
  World() = default;

  // Takes a scene and starts over; the views must stay alive and unchanged. False, and an empty
  // world, if a number of `config` is out of range, and for whatever SceneObjects::set refuses.
  bool set_scene(std::span<const Object> objects, const WorldConfig& config);

  // The time from tick to tick from now on, for effects and motions; 1 ms at the start. False, and
  // nothing changed, unless it is finite and > 0.
  bool set_tick(double tick_s);

  // Forgets the contacts and what effects remember: the next touch starts with the proxies at the
  // tools.
  void reset();

  // From the next tick on an object that `moves` stands there, and moves like that. False for
  // whatever SceneObjects::set_pose refuses.
  bool set_pose(std::uint32_t object, const RigidPose& X_WO, const Twist& twist) {
    return scene_.set_pose(object, X_WO, twist);
  }

  // From the next tick on an object feels like that, until the next scene. False for whatever
  // SceneObjects::set_material refuses.
  bool set_material(std::uint32_t object, const Material& material) {
    return scene_.set_material(object, material);
  }

  [[nodiscard]] std::size_t object_count() const { return scene_.size(); }
  // What an object below object_count() feels like now.
  [[nodiscard]] const Material& material(std::uint32_t object) const {
    return scene_.material(object);
  }

  // How far an object's proxy was from the tool after the last touch, m; the largest of all tools.
  [[nodiscard]] double stretch_m(std::uint32_t object) const;

  // From the next tick on a vertex of an object that `deforms` moves there, by at most
  // kMaxVertexStep_m a tick. False for whatever SceneObjects::move_vertex refuses.
  bool move_vertex(std::uint32_t object, std::uint32_t vertex, const Vec3& p_O) {
    return scene_.move_vertex(object, vertex, p_O);
  }

  // One tick: moves the proxies and gives the force on the hand, F = K (proxy - tool) - B v in
  // contact and zero otherwise, with v relative to the surface, and the forces of the effects.
  // Objects of the methods sphere_proxy and god_object share one proxy; with several of them in
  // contact, K and B are their mean weighted by how far each pushes. Every other object pushes for
  // itself, and the forces add up; the rest of the touch is then told of the one that pushes
  // hardest. The damper acts on the whole velocity, so a hand that leaves quickly can feel a pull
  // of at most B v. Real time: no heap, no exceptions, bounded work; trouble is in Touch::flags.
  // `path`, if given, receives the shared proxy's moves.
  Touch touch(const ToolState& tool, ProxyPath* path = nullptr);

  // One tick of all tools, which do not feel each other; touches[i] is of tools[i]. A tool without
  // a state in `tools` is taken as not valid.
  void touch(std::span<const ToolState> tools, std::span<Touch> touches);

  // What an effect has given to the hand of a tool since the start, J; see
  // rendering/effects/effect.h. Both numbers in range.
  [[nodiscard]] double delivered_J(std::size_t effect, std::size_t tool = 0) const {
    return effect_touches_[tool].delivered_J(effect);
  }

  // Most triangles ever kept near a tool, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const;

  // What it remembers, to bytes or back: of the same scene and configuration, set before. A world
  // that could not be read must be given its scene again.
  void transfer(StateArchive& archive);

 private:
  void begin_tick();
  Touch touch_one(std::size_t number, const ToolState& tool, ProxyPath* path);

  SceneObjects scene_;
  std::array<ToolTouch, kMaxTools> tools_;
  std::array<EffectTouch, kMaxTools> effect_touches_;
  std::span<const Effect> effects_;
  double tick_s_ = 0.001;
  double time_s_ = 0.0;  // since set_scene
  std::size_t tool_count_ = 1;
};

}  // namespace tactus::rendering
