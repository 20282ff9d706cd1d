// The virtual world that one or several tools touch: the entry to this folder. Once per tick it
// moves the objects, computes each tool in turn (tool_touch.h), and then moves the bodies.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "rendering/effects/effect.h"
#include "rendering/limits.h"
#include "rendering/objects/object.h"
#include "rendering/objects/object_body.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/profiles/scene_capacity.h"
#include "rendering/state_archive.h"
#include "rendering/tick_budget.h"
#include "rendering/touch.h"
#include "rendering/world/effect_touch.h"
#include "rendering/world/tool_touch.h"
#include "rendering/world/world_bodies.h"

namespace tactus::rendering {

class TickWatcher;

// The parts of a scene beside its objects.
struct WorldConfig {
  // The radius of every tool, m: 0 to kMaxToolRadius_m; 0 is the god-object point.
  double tool_radius_m = 0.0;
  // The number of tools, 1 to the number that the world has room for.
  std::size_t tool_count = 1;
  // The effects, at most kMaxEffects; each acts on every tool. The caller keeps them alive and
  // unchanged.
  std::span<const Effect> effects;
  // The bodies among the objects, each once, in any order. The caller keeps their hulls alive.
  std::span<const ObjectBody> bodies;
  // The convex parts to which the bodies refer. The caller keeps their hulls alive.
  std::span<const BodyPart> body_parts;
  // The gravity that acts on bodies, m/s^2; the default is the standard one, downward.
  Vec3 gravity_W = standard_gravity_W();
  // The effective modulus of fingers that are soft, Pa (finger_grip.h); 0 for fingers that touch in
  // a point, as those without a radius do.
  double soft_finger_modulus_Pa = 0.0;
  // The time for which bodies are at rest before they fall asleep, s; 0: never (body_sleep.h).
  double sleep_after_s = 0.0;
  // The needle of every tool, and the tissues among the objects, each once. The caller keeps the
  // tissues alive.
  NeedleScene needle;
};

// Returns the most cost units (tick_budget.h) that a tick spends before the first contact: on
// objects that move or deform, and on the effects. They cannot be cut.
std::size_t standing_units(std::span<const Object> objects, const WorldConfig& config);

// Returns what the scene has of each size of a profile.
SceneCounts scene_counts(std::span<const Object> objects, const WorldConfig& config);

// The state of one tool in a world: its contacts, and what the effects remember of it.
struct ToolSlot {
  ToolTouch touch;
  EffectTouch effects;
};

// Lives in static storage: fixed arrays of the profile's sizes (rendering/profiles), no heap. Not
// thread-safe; one thread owns it.
class World {
 public:
  // Has room for one tool.
  World() = default;
  // Has room for one tool and for those of `more_tools`, at most kMaxTools in all. The storage must
  // outlive the world, which must not be copied then.
  explicit World(std::span<ToolSlot> more_tools)
      : more_tools_(more_tools.first(std::min(more_tools.size(), kMaxTools - 1))) {}

  // Sets a scene and starts over; the views must stay alive and unchanged. Returns false, and
  // leaves an empty world, if scene_counts() exceed a capacity of kProfile
  // (rendering/profiles/scene_capacity.h) or the world's room for tools, a number of `config` is
  // out of range, or SceneObjects::set or WorldBodies::set refuses.
  bool set_scene(std::span<const Object> objects, const WorldConfig& config);

  // Sets the time from tick to tick, for effects and motions; 1 ms by default. The budget of a tick
  // becomes default_tick_instructions() (tick_budget.h). Returns false,
  // and changes nothing, unless it is finite and > 0.
  bool set_tick(double tick_s);

  // Sets the instructions that a tick of all tools may take, after set_tick(). Objects, effects and
  // contacts share them, in this order. Infinity is no
  // limit, for tests and comparisons. Returns false, and changes nothing, unless it is > 0.
  bool set_tick_budget(double instructions);

  // Returns the cost units that a tick may spend.
  [[nodiscard]] std::size_t budget_units() const { return budget_; }

  // Forgets the contacts and what effects remember: the next touch starts with the proxies at the
  // tools. Bodies stay where they are.
  void reset();
  // Forgets those of one tool, which must be below tool_capacity().
  void reset(std::size_t tool);

  // Returns the most tools that the world has room for.
  [[nodiscard]] std::size_t tool_capacity() const { return 1 + more_tools_.size(); }

  // Sets the pose and velocity of an object that `moves` from the next tick on. Returns false if
  // SceneObjects::set_pose refuses.
  bool set_pose(std::uint32_t object, const RigidPose& X_WO, const Twist& twist) {
    bodies_.wake(object);
    return scene_.set_pose(object, X_WO, twist);
  }

  // Sets the material of an object from the next tick on, until the next scene. Returns false if
  // SceneObjects::set_material refuses.
  bool set_material(std::uint32_t object, const Material& material) {
    return scene_.set_material(object, material);
  }

  // Returns true if a tool touches the object, or overlaps it, after the last touch.
  [[nodiscard]] bool is_touched(std::uint32_t object) const;
  // Returns true if no tool would feel it if the object had another method now: none touches the
  // object, and if it meets the shared proxy before or afterwards, no shared proxy touches
  // anything.
  [[nodiscard]] bool may_set_method(std::uint32_t object, ContactMethod method) const;
  // Returns false if the method would give the object a contact of its own, and
  // kMaxIndependentObjects others have one.
  [[nodiscard]] bool has_room_for(std::uint32_t object, ContactMethod method) const {
    return scene_.has_room_for(object, method);
  }
  // Sets the contact method of an object from the next tick on, until the next scene. The contacts
  // of all other objects go on as they are. Returns false, and changes nothing, unless
  // may_set_method(), or if SceneObjects::set_method refuses. Real time; if the object joins or
  // leaves the shared proxy, the time grows with the number of objects.
  bool set_method(std::uint32_t object, ContactMethod method);

  // Return an object with its changes, and as the scene has it; `object` must be below
  // object_count().
  [[nodiscard]] const Object& object(std::uint32_t object) const { return scene_[object]; }
  [[nodiscard]] const Object& unchanged_object(std::uint32_t object) const {
    return scene_.unchanged(object);
  }

  // Returns the number of objects.
  [[nodiscard]] std::size_t object_count() const { return scene_.size(); }
  // Returns the current material of an object; `object` must be below object_count().
  [[nodiscard]] const Material& material(std::uint32_t object) const {
    return scene_.material(object);
  }

  // Returns how far an object's proxy was from the tool after the last touch, m; the largest of all
  // tools.
  [[nodiscard]] double stretch_m(std::uint32_t object) const;

  // Moves a vertex of an object that `deforms` from the next tick on, by at most kMaxVertexStep_m
  // per tick. Returns false if SceneObjects::move_vertex refuses.
  bool move_vertex(std::uint32_t object, std::uint32_t vertex, const Vec3& p_O) {
    return scene_.move_vertex(object, vertex, p_O);
  }

  // Computes one tick: moves the proxies and returns the force on the hand. The force is F = K
  // (proxy - tool) - B v in contact and zero otherwise, plus the forces of the effects; v is
  // relative to the surface.
  //
  // Objects of the methods sphere_proxy and god_object share one proxy. With several of them in
  // contact, K and B are means weighted by the pressures. Every other object gives its own force,
  // and the forces add up; the other fields of the touch describe the object with the largest
  // force. The damper acts on the whole velocity, so a hand that leaves quickly can feel a pull of
  // at most B v.
  //
  // A body that a tool holds moves after the touch, and its force on the hand is that of its
  // solver: the impulse on the body over the period (rendering/bodies).
  //
  // Real time: no heap, no exceptions, bounded time; limits that were reached are in Touch::flags.
  Touch touch(const ToolState& tool);
  // The same; `watcher` sees the moves if it is not null.
  Touch touch(const ToolState& tool, TickWatcher* watcher);

  // Computes one tick of all tools; touches[i] is of tools[i]. Tools do not feel each other but
  // through the bodies that they hold. A tool without a state in `tools` counts as invalid.
  void touch(std::span<const ToolState> tools, std::span<Touch> touches);
  // The same; `watchers[i]` sees the moves of tools[i]. It may be null or missing.
  void touch(std::span<const ToolState> tools, std::span<Touch> touches,
             std::span<TickWatcher* const> watchers);

  // Returns the needle of a tool after the last touch; `tool` must be in range.
  [[nodiscard]] const NeedleTouch& needle(std::size_t tool = 0) const {
    return slot(tool).touch.needle();
  }

  // Returns the objects that move or deform, at their places in the last touch.
  [[nodiscard]] std::span<const Mover> movers() const { return scene_.movers(); }

  // Returns the body of an object after the last touch, or nullptr.
  [[nodiscard]] const RigidBody* body(std::uint32_t object) const { return bodies_.of(object); }
  // Returns the work that all tools have done on an object's body in the last touch, J.
  [[nodiscard]] double work_by_hands_J(std::uint32_t object) const {
    return bodies_.work_by_hands_J(object);
  }
  // Returns all that moves by forces.
  [[nodiscard]] const BodyWorld& bodies() const { return bodies_.bodies(); }

  // Returns the energy that an effect has given to the hand of a tool since the start, J (see
  // rendering/effects/effect.h). Both numbers must be in range.
  [[nodiscard]] double delivered_J(std::size_t effect, std::size_t tool = 0) const {
    return slot(tool).effects.delivered_J(effect);
  }

  // Returns the cost units that the last touch has spent, of all tools (tick_budget.h).
  [[nodiscard]] std::size_t spent_units() const;

  // Returns the largest number of candidates near a tool so far, of kMaxCandidates.
  [[nodiscard]] std::size_t peak_candidates() const;

  // Saves the state to the archive, or restores it; scene and configuration must be the same and
  // set before. After a failed restore the world must be given its scene again.
  void transfer(StateArchive& archive);

 private:
  // Moves the objects to their places in this tick. Returns the cost units that are left for the
  // contacts of all tools.
  std::size_t begin_tick();
  // Computes a tick of the first tool.
  template <class Watch>
  Touch touch_only(const ToolState& tool, Watch watch);
  // Computes a tick of all tools; touch_number(i, tool, limit) computes one of them. `watch` sees
  // the steps of all.
  void touch_all(std::span<const ToolState> tools, std::span<Touch> touches, const auto& watch,
                 const auto& touch_number);
  // Computes one tool with its effects, within `limit` cost units.
  template <class Watch>
  Touch touch_one(std::size_t number, const ToolState& tool, std::size_t limit, Watch watch);

  // Moves the bodies after the touches of this tick, and puts their forces into these.
  void step_bodies(std::span<Touch> touches);

  [[nodiscard]] ToolSlot& slot(std::size_t tool) {
    return tool == 0 ? first_tool_ : more_tools_[tool - 1];
  }
  [[nodiscard]] const ToolSlot& slot(std::size_t tool) const {
    return tool == 0 ? first_tool_ : more_tools_[tool - 1];
  }

  // Returns true if `has(contacts)` is true for a tool.
  template <class Has>
  [[nodiscard]] bool any_tool(const Has& has) const {
    for (std::size_t i = 0; i < tool_count_; ++i) {
      if (has(slot(i).touch)) {
        return true;
      }
    }
    return false;
  }

  SceneObjects scene_;
  WorldBodies bodies_;
  ToolSlot first_tool_;
  std::span<ToolSlot> more_tools_;
  std::span<const Effect> effects_;
  // The time from tick to tick, s.
  double tick_s_ = 0.001;
  // The time since set_scene, s, in ticks: no clock is read.
  double time_s_ = 0.0;
  std::size_t tool_count_ = 1;
  // The cost units of a tick, and those that the last tick spent on the objects and the effects.
  std::size_t budget_ = units_of(kTickInstructions_per_s * 0.001);
  std::size_t standing_units_ = 0;
};

// A world with room for `kTools` tools, in the storage of its owner.
template <std::size_t kTools>
class WorldOf : private std::array<ToolSlot, kTools - 1>, public World {
  static_assert(kTools >= 1 && kTools <= kMaxTools);

 public:
  WorldOf() : World(std::span<ToolSlot>(static_cast<std::array<ToolSlot, kTools - 1>&>(*this))) {}
  WorldOf(const WorldOf&) = delete;
  WorldOf& operator=(const WorldOf&) = delete;
  ~WorldOf() = default;
};

}  // namespace tactus::rendering
