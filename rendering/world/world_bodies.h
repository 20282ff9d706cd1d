// The bodies among the objects of a world: where they are in a tick, and what the tools' contacts
// do to them. World has one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/body_world.h"
#include "rendering/bodies/primitive_hull.h"
#include "rendering/limits.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"
#include "rendering/world/tool_grip.h"

namespace tactus::rendering {

// The laws of a scene's bodies.
struct BodyLaws {
  // The gravity, m/s^2.
  Vec3 gravity_W = standard_gravity_W();
  // The yield of soft fingers, m^3/N; 0 for fingers that touch in a point (finger_grip.h).
  double finger_yield_m3_per_N = 0.0;
  // The time for which bodies are at rest before they fall asleep, s; 0: never (body_sleep.h).
  double sleep_after_s = 0.0;
};

// Every object that names an ObjectBody is a body; every other object is an obstacle to bodies,
// also where it moves by itself. Bodies go through meshes that deform.
class WorldBodies {
 public:
  // Starts over with the bodies of a scene; the objects stay alive. Returns false, and has no
  // bodies, if there are more than kMaxBodies, or more than kMaxObstacles beside them, or if an
  // object names a body that is not there or not sound, or a body names parts that are not there,
  // or more than kMaxPartsOfBody or kMaxBodyParts.
  bool set(const SceneObjects& scene, std::span<const ObjectBody> bodies,
           std::span<const BodyPart> parts, const BodyLaws& laws);

  // Returns true if there are bodies.
  [[nodiscard]] bool any() const { return !bodies_.bodies().empty(); }
  // Returns the body of an object, or nullptr.
  [[nodiscard]] const RigidBody* of(std::uint32_t object) const;
  // Returns the bodies' world.
  [[nodiscard]] const BodyWorld& bodies() const { return bodies_; }

  // Returns the work that all tools have done on the body of an object in the last tick, J; 0
  // without a body. The torque of soft fingers about their normals is not in it.
  [[nodiscard]] double work_by_hands_J(std::uint32_t object) const;

  // Wakes the body of an object that has one.
  void wake(std::uint32_t object);

  // Moves the objects to where their bodies are. Call it before SceneObjects::begin_tick().
  void place(SceneObjects& scene) const;

  // Computes one tick of all bodies with the grips of all tools; each grip gets the force of its
  // body on the hand.
  void step(const SceneObjects& scene, std::span<ToolGrips> tools);

  // Saves the state to the archive, or restores it; the scene must be the same.
  void transfer(StateArchive& archive);

 private:
  // Returns the number of an object's body among the bodies; their number if it is none.
  [[nodiscard]] std::size_t number_of(std::uint32_t object) const;
  // Adds an object, as a body if `body` is not nullptr.
  bool add(const SceneObjects& scene, std::uint32_t number, const ObjectBody* body);
  // Makes the hulls of the parts. Returns false if there are too many, or one is not convex.
  bool make_parts(std::span<const BodyPart> parts);
  // Adds a body with this hull, or with those of its parts. Returns false if they are not there.
  bool add_body(const ObjectBody& body, const ConvexHull& hull, const ContactSurface& surface);

  BodyWorld bodies_;
  // The numbers of the objects that are bodies and obstacles.
  std::array<std::uint32_t, kMaxBodies> body_objects_{};
  std::array<std::uint32_t, kMaxObstacles> obstacle_objects_{};
  std::size_t obstacle_count_ = 0;
  // The work of all tools on each body in the last tick, J.
  std::array<double, kMaxBodies> work_by_hands_J_{};
  // The hulls of primitives among them.
  std::array<PrimitiveHull, kMaxBodies + kMaxObstacles> hulls_;
  // The hulls of the scene's parts; those of primitives refer to primitive_parts_.
  std::array<ConvexHull, kMaxBodyParts> part_hulls_;
  std::array<PrimitiveHull, kMaxBodyParts> primitive_parts_;
  std::size_t part_count_ = 0;
};

}  // namespace tactus::rendering
