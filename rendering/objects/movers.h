// The objects of a scene that move or deform, at their places in this tick. SceneObjects owns them;
// the contact methods ask for the pose before and the pose now.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/objects/motion.h"
#include "rendering/objects/object.h"
#include "rendering/objects/vertex_wave.h"
#include "rendering/state_archive.h"
#include "rendering/surface/deformable_mesh.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// An object that moves. Its frame O is the frame in which the scene gives it; X_WO is the pose of O
// in the world.
struct Mover {
  // The object's number in the scene.
  std::uint32_t object = 0;
  // The pose of O in the last tick and in this one.
  RigidPose X_WO_before;
  RigidPose X_WO;
  // The velocity of O in this tick, for friction, damping and the power of driven surfaces.
  Twist twist;
  // The mesh of an object that deforms; nullptr for a rigid one.
  const DeformableMesh* deformable = nullptr;
  // The primitive of an object without a mesh at its place in this tick.
  Primitive primitive_W;
  // The box of all that the proxy can touch; frame O, m.
  Bounds bounds_O;
  // The object's own motion, until the outside takes over; nullptr then.
  const Motion* motion = nullptr;
  // The vertices of the wave; none if there is no wave.
  WaveVertices wave;
  // The vertex whose turn it is in the waves.
  std::uint32_t next_vertex = 0;
  // True if the object has moved or deformed since the last tick.
  bool moved = false;

  // A ball about all that the proxy can touch, which rules out most objects at a fraction of the
  // box's cost: its middle now and in the last tick (world frame, m), its radius, how far the
  // middle has moved since (m), and the most that a vector of length 1 has been turned by. It is in
  // the middle of the box.
  Vec3 middle_W = Vec3::Zero();
  Vec3 middle_before_W = Vec3::Zero();
  double radius_m = 0.0;
  double shift_m = 0.0;
  double turn = 0.0;

  // Return true if the object's box and ball come within `reach_m` of p_W: at its place now, and at
  // its place in the last tick.
  [[nodiscard]] bool is_near(const Vec3& p_W, double reach_m) const;
  [[nodiscard]] bool was_near(const Vec3& p_W, double reach_m) const;
  // Returns true if a point that goes from `from_W` in the last tick to `to_W` in this one, which
  // are `distance_m` apart, stays farther than `reach_m` from the ball, seen from the object. It
  // may return false for another one too.
  [[nodiscard]] bool is_passed_by(const Vec3& from_W, double distance_m, double reach_m) const;

  // Sets the box, and the ball's radius so that it holds the box. `reaches_m` says that nothing of
  // the object is farther from the box's middle than that.
  void set_bounds(const Bounds& box_O, double reaches_m = std::numeric_limits<double>::infinity());
  // Sets the ball's place from the poses and the box.
  void place_ball();
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

// Lives in static storage; no heap. One thread owns it. The outside sets poses and vertices at any
// time between two ticks; begin_tick() makes them the ones of the tick.
class Movers {
 public:
  // Starts with those of `objects` that move or deform, each at X_WO = identity. The objects must
  // stay alive and unchanged. Returns false if they exceed the capacities (ObjectNeeds).
  bool start(std::span<const Object> objects);

  // Set the pose or a vertex from the next tick on, and end the object's own motion. They refuse as
  // SceneObjects::set_pose and move_vertex do; `number` must be that of an object.
  bool set_pose(std::uint32_t number, const RigidPose& X_WO, const Twist& twist);
  bool move_vertex(std::uint32_t number, std::uint32_t vertex, const Vec3& p_O);

  // Moves every object to its place in the tick that begins `time_s` after the start. Returns the
  // cost units that it took (tick_budget.h).
  std::size_t begin_tick(double time_s);

  // Returns the mover of object `number`, or nullptr if it is at rest.
  [[nodiscard]] const Mover* of(std::uint32_t number) const {
    return mover_of_[number] == kNoMover ? nullptr : &movers_[mover_of_[number]];
  }
  // Returns all movers, in the order of their objects.
  [[nodiscard]] std::span<const Mover> all() const { return {movers_.data(), count_}; }
  // Returns the number of movers that deform.
  [[nodiscard]] std::size_t deformable_count() const { return deformable_count_; }
  // Returns true if an object has moved or deformed since the last tick.
  [[nodiscard]] bool anything_moved() const { return anything_moved_; }

  // Saves the state to the archive, or restores it; the objects must be the same.
  void transfer(StateArchive& archive);
  // Saves or restores anything_moved() alone.
  void transfer_moved(StateArchive& archive) { archive(anything_moved_); }

 private:
  static constexpr std::uint8_t kNoMover = 0xff;
  static_assert(kMaxMovers < kNoMover);

  // The place that an object takes in the next tick.
  struct Order {
    RigidPose X_WO;
    Twist twist;
  };

  // Adds the mover of one object. Returns false if a mesh that deforms does not fit.
  bool start_one(std::uint32_t number);
  // Returns the mesh of a mover that deforms, to be changed.
  DeformableMesh& deformable_of(const Mover& mover);
  // Returns the vertices of an object's wave, which it keeps; none without a wave.
  WaveVertices start_wave(const Object& object);
  // Moves one mover to its place in this tick; returns the cost units.
  std::size_t begin_tick_of(std::size_t k, double time_s);
  // Moves the vertices whose turn it is to their places in the wave; returns the cost units.
  std::size_t wave(Mover& mover, double time_s);
  void transfer_one(StateArchive& archive, std::size_t k);

  std::span<const Object> objects_;
  // The mover's index for each object, or kNoMover.
  std::array<std::uint8_t, kMaxObjects> mover_of_{};
  std::array<Mover, kMaxMovers> movers_{};
  // The poses for the next tick, one for each mover.
  std::array<Order, kMaxMovers> orders_{};
  std::size_t count_ = 0;
  bool anything_moved_ = false;
  DeformablePool pool_;
  // The waves of the vertices of the pool.
  WavePool wave_pool_;
  std::array<DeformableMesh, kMaxDeformables> deformables_;
  std::size_t deformable_count_ = 0;
};

}  // namespace tactus::rendering
