// The objects of a scene at their places in this tick: those at rest under a hierarchy of their
// boxes, and those that move. World owns them; every contact method reads them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/triangle.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/objects/changed_objects.h"
#include "rendering/objects/movers.h"
#include "rendering/objects/object.h"
#include "rendering/objects/still_hierarchy.h"
#include "rendering/profiles/scene_capacity.h"
#include "rendering/state_archive.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// A mesh as it is in this tick. A search through its hierarchy must reach farther by `slack_m`.
struct PlacedMesh {
  MeshView mesh;
  double slack_m = 0.0;
};

// The capacities that some objects need, and the time.
class ObjectNeeds {
 public:
  // Adds the needs of one object.
  void add(const Object& object);

  // Returns the counts of objects of all kinds; all others are 0.
  [[nodiscard]] SceneCounts counts() const;
  // Returns the most cost units (tick_budget.h) that moving the objects takes in one tick.
  [[nodiscard]] std::size_t motion_units() const { return motion_units_; }

 private:
  SceneCounts counts_;
  // The objects that bodies meet, if there are bodies.
  std::size_t solids_ = 0;
  std::size_t motion_units_ = 0;
};

// Returns the needs of the objects.
ObjectNeeds needs_of(std::span<const Object> objects);

// Lives in static storage; no heap. One thread owns it. Object numbers are indices of the span that
// set() was given.
class SceneObjects {
 public:
  // Sets the objects, each at X_WO = identity; the views must stay alive and unchanged. Returns
  // false, and leaves no objects, if they exceed a capacity (rendering/profiles/scene_capacity.h),
  // or one is not usable().
  bool set(std::span<const Object> objects);

  // Sets the pose and velocity of object `number` from the next tick on. Returns false, and changes
  // nothing, if the object does not move, a number is not finite, the rotation is not orthonormal
  // and right-handed to 1e-9, or its origin is farther than kWorldBound_m from the world's.
  bool set_pose(std::uint32_t number, const RigidPose& X_WO, const Twist& twist);

  // Moves a vertex of an object that deforms from the next tick on; frame O, m (see
  // DeformableMesh). Returns false, and changes nothing, for anything else.
  bool move_vertex(std::uint32_t number, std::uint32_t vertex, const Vec3& p_O);

  // Sets the material of an object from the next tick on. Returns false, and changes nothing, if
  // there is no such object, the material is not sound(), or kMaxChangedObjects others have been
  // changed since set().
  bool set_material(std::uint32_t number, const Material& material);

  // Sets the contact method of an object from the next tick on, and groups the objects anew into
  // those of the shared proxy and the others. Returns false, and changes nothing, if there is no
  // such object, can_render() or has_room_for() says no, or kMaxChangedObjects others have been
  // changed. The caller must tell the tools.
  bool set_method(std::uint32_t number, ContactMethod method);

  // Returns false if the method would give the object a contact of its own, and
  // kMaxIndependentObjects others have one.
  [[nodiscard]] bool has_room_for(std::uint32_t number, ContactMethod method) const {
    return meets_proxy(method) || !meets_proxy((*this)[number]) ||
           independent_count_ < kMaxIndependentObjects;
  }

  // Begins a tick, `time_s` after the scene was set, which lasts `tick_s`. Objects move to where
  // their own motion has them now, or where the outside set them since the last tick. Returns the
  // cost units that it took (tick_budget.h).
  std::size_t begin_tick(double time_s, double tick_s);
  // Returns the duration of the tick, s.
  [[nodiscard]] double tick_s() const { return tick_s_; }

  // Return the number of objects, and one of them with its changes.
  [[nodiscard]] std::size_t size() const { return objects_.size(); }
  [[nodiscard]] const Object& operator[](std::uint32_t number) const {
    return changed_.of(number, objects_[number]);
  }
  // Returns object `number` as set() was given it.
  [[nodiscard]] const Object& unchanged(std::uint32_t number) const { return objects_[number]; }
  // Returns the current material of object `number`: the scene's, or the one of set_material.
  [[nodiscard]] const Material& material(std::uint32_t number) const {
    return (*this)[number].material;
  }
  // Returns the mover of object `number`, or nullptr if it is at rest.
  [[nodiscard]] const Mover* mover_of(std::uint32_t number) const { return movers_.of(number); }
  // Returns the mesh of an object as it is in this tick; frame O.
  [[nodiscard]] PlacedMesh mesh_O(std::uint32_t number) const {
    const Mover* const mover = mover_of(number);
    if (mover == nullptr || mover->deformable == nullptr) {
      return {.mesh = objects_[number].mesh};
    }
    return {.mesh = mover->deformable->now(), .slack_m = mover->deformable->slack_m()};
  }
  // Returns the primitive of an object without a mesh at its place in this tick; world frame.
  [[nodiscard]] const Primitive& primitive_W(std::uint32_t number) const {
    const Mover* const mover = mover_of(number);
    return mover == nullptr ? objects_[number].primitive : mover->primitive_W;
  }

  // Returns the velocity of the object's surface at p_W; world frame, m/s.
  [[nodiscard]] Vec3 velocity_W(std::uint32_t number, const Vec3& p_W) const {
    const Mover* const mover = mover_of(number);
    return mover == nullptr ? Vec3{Vec3::Zero()} : mover->twist.at(p_W - mover->X_WO.translation);
  }

  // Returns the objects that move or deform.
  [[nodiscard]] std::span<const Mover> movers() const { return movers_.all(); }
  // Returns true if one of them has moved or deformed since the last tick.
  [[nodiscard]] bool anything_moved() const { return movers_.anything_moved(); }

  // Returns true if there is an object that meets the shared proxy.
  [[nodiscard]] bool any_meets_proxy() const { return independent_count_ < objects_.size(); }

  // Returns the numbers of the objects that the shared proxy does not meet.
  [[nodiscard]] std::span<const std::uint32_t> independent_objects() const {
    return {independent_.data(), independent_count_};
  }

  // Returns the hierarchy over the boxes of the objects that are at rest and meet the shared proxy;
  // empty if there are none. The "triangles" of a leaf are indices of still_object().
  [[nodiscard]] std::span<const BvhNode> still_nodes() const { return still_.nodes(); }
  [[nodiscard]] std::uint32_t still_object(std::uint32_t place) const {
    return still_.object(place);
  }

  // Saves the state to the archive, or restores it; the objects must be the same.
  void transfer(StateArchive& archive);

 private:
  // Returns the number of objects that the shared proxy does not meet.
  [[nodiscard]] std::size_t count_independent() const;
  // Lists the objects by whether they meet the shared proxy.
  void group();
  void transfer_changed(StateArchive& archive);

  std::span<const Object> objects_;
  double tick_s_ = 1e-3;
  Movers movers_;
  ChangedObjects changed_;
  StillHierarchy still_;
  // The numbers of the objects that the shared proxy does not meet.
  std::array<std::uint32_t, kMaxIndependentObjects> independent_{};
  std::size_t independent_count_ = 0;
};

// Returns a triangle of an object's mesh at its place in this tick; world frame.
Triangle triangle_W(const SceneObjects& scene, std::uint32_t number, std::uint32_t triangle);

}  // namespace tactus::rendering
