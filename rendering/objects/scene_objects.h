// The objects of a scene at their places in this tick: those at rest under a hierarchy of their
// boxes, and those that move.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/triangle.h"
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

// A mesh as it is in this tick. A search through its hierarchy must reach farther by `slack_m`.
struct PlacedMesh {
  MeshView mesh;
  double slack_m = 0.0;
};

// The share of the fixed capacities that some objects need.
struct SceneCapacityNeeds {
  std::size_t movers = 0;       // objects that move or deform
  std::size_t independent = 0;  // that the shared proxy does not meet
  std::size_t deformables = 0;
  std::size_t deformable_vertices = 0;
  std::size_t deformable_nodes = 0;

  void add(const Object& object);
  // Returns true if the needs are within kMaxMovers, kMaxIndependentObjects, kMaxDeformables,
  // kMaxDeformableVertices and kMaxDeformableNodes.
  [[nodiscard]] bool fit() const;
};

// Lives in static storage; no heap. One thread owns it.
class SceneObjects {
 public:
  // Sets the objects, each at X_WO = identity; the views must stay alive and unchanged. Returns
  // false, and leaves no objects, if there are more than kMaxObjects, more than kMaxMovers that
  // move or deform, more than kMaxIndependentObjects that the shared proxy does not meet, more that
  // deform than fit, or one that is not usable().
  bool set(std::span<const Object> objects);

  // Sets the pose and velocity of object `number` from the next tick on. Returns false, and changes
  // nothing, if the object does not move, a number is not finite, the rotation is not orthonormal
  // and right-handed to 1e-9, or its origin is farther than kWorldBound_m from the world's.
  bool set_pose(std::uint32_t number, const RigidPose& X_WO, const Twist& twist);

  // Moves a vertex of an object that deforms from the next tick on; frame O, m (see
  // DeformableMesh). Returns false, and changes nothing, for anything else.
  bool move_vertex(std::uint32_t number, std::uint32_t vertex, const Vec3& p_O);

  // Sets the material of an object from the next tick on. Returns false, and changes nothing, if
  // there is no such object, the material is not sound(), or kMaxChangedMaterials others have been
  // changed since set().
  bool set_material(std::uint32_t number, const Material& material);

  // Begins a tick, `time_s` after the scene was set, which lasts `tick_s`. Objects move to where
  // their own motion has them now, or where the outside set them since the last tick.
  void begin_tick(double time_s, double tick_s);
  [[nodiscard]] double tick_s() const { return tick_s_; }

  [[nodiscard]] std::size_t size() const { return objects_.size(); }
  [[nodiscard]] const Object& operator[](std::uint32_t number) const { return objects_[number]; }
  [[nodiscard]] std::span<const Object> objects() const { return objects_; }
  // Returns the current material of object `number`: the scene's, or the one of set_material.
  [[nodiscard]] const Material& material(std::uint32_t number) const {
    const std::uint8_t changed = changed_of_[number];
    return changed == kUnchanged ? objects_[number].material : changed_materials_[changed];
  }
  // Returns the mover of object `number`, or nullptr if it is at rest.
  [[nodiscard]] const Mover* mover_of(std::uint32_t number) const {
    return mover_of_[number] == kNoMover ? nullptr : &movers_[mover_of_[number]];
  }
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

  [[nodiscard]] std::span<const Mover> movers() const { return {movers_.data(), mover_count_}; }
  [[nodiscard]] bool anything_moved() const { return anything_moved_; }

  [[nodiscard]] bool any_meets_proxy() const { return independent_count_ < objects_.size(); }

  // Returns the numbers of the objects that the shared proxy does not meet.
  [[nodiscard]] std::span<const std::uint32_t> independent_objects() const {
    return {independent_.data(), independent_count_};
  }

  // Returns the hierarchy over the boxes of the objects that are at rest and meet the shared proxy;
  // empty if there are none. The "triangles" of a leaf are indices of still_object().
  [[nodiscard]] std::span<const BvhNode> still_nodes() const {
    return {nodes_.data(), node_count_};
  }
  [[nodiscard]] std::uint32_t still_object(std::uint32_t place) const { return order_[place]; }

  // Saves the state to the archive, or restores it; the objects must be the same.
  void transfer(StateArchive& archive);

 private:
  static constexpr std::uint8_t kNoMover = 0xff;
  static_assert(kMaxMovers < kNoMover);
  static constexpr std::uint8_t kUnchanged = 0xff;
  static_assert(kMaxChangedMaterials < kUnchanged);

  struct Part {
    std::uint32_t node;
    std::uint32_t first;  // place of still_object()
    std::uint32_t count;
  };

  bool start_mover(std::uint32_t number);
  DeformableMesh& deformable_of(const Mover& mover);
  void begin_tick_of(std::size_t k, double time_s);
  void wave(Mover& mover, double time_s);
  void build_hierarchy();
  [[nodiscard]] Vec3 centre(std::uint32_t number) const;
  Eigen::Index enclose(const Part& part);
  void halve(const Part& part, Eigen::Index axis);
  void transfer_materials(StateArchive& archive);
  void transfer_mover(StateArchive& archive, std::size_t k);

  std::span<const Object> objects_;
  std::array<std::uint8_t, kMaxObjects> mover_of_{};
  std::array<Mover, kMaxMovers> movers_{};
  struct Order {
    RigidPose X_WO;
    Twist twist;
  };
  std::array<Order, kMaxMovers> orders_{};  // what set_pose left
  std::size_t mover_count_ = 0;
  std::array<std::uint8_t, kMaxObjects> changed_of_{};
  std::array<Material, kMaxChangedMaterials> changed_materials_{};
  std::size_t changed_count_ = 0;
  bool anything_moved_ = false;
  double tick_s_ = 1e-3;
  DeformablePool pool_;
  std::array<DeformableMesh, kMaxDeformables> deformables_;
  std::size_t deformable_count_ = 0;
  std::array<std::uint32_t, kMaxIndependentObjects> independent_{};
  std::size_t independent_count_ = 0;
  std::array<BvhNode, 2 * kMaxObjects> nodes_{};
  std::size_t node_count_ = 0;
  std::array<std::uint32_t, kMaxObjects> order_{};
};

// Returns a triangle of an object's mesh at its place in this tick; world frame.
Triangle triangle_W(const SceneObjects& scene, std::uint32_t number, std::uint32_t triangle);

}  // namespace tactus::rendering
