// The objects of a scene that move or deform, at their places in this tick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/objects/motion.h"
#include "rendering/objects/object.h"
#include "rendering/state_archive.h"
#include "rendering/surface/deformable_mesh.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// An object that moves. Its frame O is the frame in which the scene gives it; X_WO is the pose of O
// in the world.
struct Mover {
  std::uint32_t object = 0;
  RigidPose X_WO_before;  // in the last tick
  RigidPose X_WO;         // in this one
  Twist twist;
  const DeformableMesh* deformable = nullptr;  // of one that deforms
  Primitive primitive_W;           // of an object without a mesh: where it is in this tick
  Bounds bounds_O;                 // of what the proxy can touch
  const Motion* motion = nullptr;  // its own, until the outside takes over
  std::uint32_t next_vertex = 0;   // whose turn it is in the waves
  bool moved = false;              // since the last tick, or deformed

  // Return the distance from p_W to the object's box, m, 0 inside: at its place now, and at its
  // place in the last tick.
  [[nodiscard]] double distance(const Vec3& p_W) const;
  [[nodiscard]] double distance_before(const Vec3& p_W) const;
};

// Convert points and directions to the frame O of an object and back. A mover of nullptr is an
// object at rest.
inline Vec3 point_in(const Mover* mover, const Vec3& p_W) {
  return mover == nullptr ? p_W : mover->X_WO.point_in(p_W);
}
inline Vec3 point_in_before(const Mover* mover, const Vec3& p_W) {
  return mover == nullptr ? p_W : mover->X_WO_before.point_in(p_W);
}
inline Vec3 direction_in(const Mover* mover, const Vec3& d_W) {
  return mover == nullptr ? d_W : mover->X_WO.direction_in(d_W);
}
inline Vec3 point_from(const Mover* mover, const Vec3& p_O) {
  return mover == nullptr ? p_O : mover->X_WO.point(p_O);
}
inline Vec3 direction_from(const Mover* mover, const Vec3& d_O) {
  return mover == nullptr ? d_O : mover->X_WO.direction(d_O);
}

// Lives in static storage; no heap. One thread owns it.
class Movers {
 public:
  // Starts with those of `objects` that move or deform, each at X_WO = identity. The objects must
  // stay alive and unchanged. Returns false if they exceed the capacities (SceneCapacityNeeds).
  bool start(std::span<const Object> objects);

  // SceneObjects::set_pose and move_vertex, for a number that is an object's.
  bool set_pose(std::uint32_t number, const RigidPose& X_WO, const Twist& twist);
  bool move_vertex(std::uint32_t number, std::uint32_t vertex, const Vec3& p_O);

  // Moves every object to its place in the tick that begins `time_s` after the start.
  void begin_tick(double time_s);

  // Returns the mover of object `number`, or nullptr if it is at rest.
  [[nodiscard]] const Mover* of(std::uint32_t number) const {
    return mover_of_[number] == kNoMover ? nullptr : &movers_[mover_of_[number]];
  }
  [[nodiscard]] std::span<const Mover> all() const { return {movers_.data(), count_}; }
  [[nodiscard]] std::size_t deformable_count() const { return deformable_count_; }
  // Returns true if an object has moved or deformed since the last tick.
  [[nodiscard]] bool anything_moved() const { return anything_moved_; }

  // Saves the state to the archive, or restores it; the objects must be the same.
  void transfer(StateArchive& archive);
  void transfer_moved(StateArchive& archive) { archive(anything_moved_); }

 private:
  static constexpr std::uint8_t kNoMover = 0xff;
  static_assert(kMaxMovers < kNoMover);

  // The place that an object takes in the next tick.
  struct Order {
    RigidPose X_WO;
    Twist twist;
  };

  bool start_one(std::uint32_t number);
  DeformableMesh& deformable_of(const Mover& mover);
  void begin_tick_of(std::size_t k, double time_s);
  void wave(Mover& mover, double time_s);
  void transfer_one(StateArchive& archive, std::size_t k);

  std::span<const Object> objects_;
  std::array<std::uint8_t, kMaxObjects> mover_of_{};
  std::array<Mover, kMaxMovers> movers_{};
  std::array<Order, kMaxMovers> orders_{};
  std::size_t count_ = 0;
  bool anything_moved_ = false;
  DeformablePool pool_;
  std::array<DeformableMesh, kMaxDeformables> deformables_;
  std::size_t deformable_count_ = 0;
};

}  // namespace tactus::rendering
