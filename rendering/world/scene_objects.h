// The objects of a scene where they are in this tick: those that stand still under a hierarchy of
// their boxes, and those that the outside moves.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/triangle.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/state/state_archive.h"
#include "rendering/surface/deformable_mesh.h"
#include "rendering/surface/mesh.h"
#include "rendering/surface/primitive.h"
#include "rendering/world/motion.h"
#include "rendering/world/object.h"

namespace tactus::rendering {

// An object that moves. Its own frame O is the frame in which the scene gives it; X_WO says where
// that frame is.
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

  // Distance from p_W to the box, 0 inside: where it is now, and where it was in the last tick.
  [[nodiscard]] double distance(const Vec3& p_W) const;
  [[nodiscard]] double distance_before(const Vec3& p_W) const;
};

// To the frame O of an object and from it; the same for one that stands still, a mover of nullptr.
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

// A search through the hierarchy has to reach by the slack farther than it means to.
struct PlacedMesh {
  MeshView mesh;
  double slack_m = 0.0;
};

// What of the fixed sizes of a scene some objects would take.
struct SceneCapacityNeeds {
  std::size_t movers = 0;       // objects that move or deform
  std::size_t independent = 0;  // that the shared proxy does not meet
  std::size_t deformables = 0;
  std::size_t deformable_vertices = 0;
  std::size_t deformable_nodes = 0;

  void add(const Object& object);
  // In kMaxMovers, kMaxIndependentObjects, kMaxDeformables, kMaxDeformableVertices,
  // kMaxDeformableNodes.
  [[nodiscard]] bool fit() const;
};

// Lives in static storage; no heap. One thread owns it.
class SceneObjects {
 public:
  // Takes the objects, each at X_WO = identity; the views must stay alive and unchanged. False, and
  // none, if there are more than kMaxObjects, more than kMaxMovers that move or deform, more
  // than kMaxIndependentObjects that the shared proxy does not meet, more that deform than there is
  // room for, or one that is not usable().
  bool set(std::span<const Object> objects);

  // From the next tick on object `number` stands there. False, and nothing changed, if it is not an
  // object that moves, or if a number is not finite, the rotation not orthonormal and right-handed
  // to 1e-9, or its origin farther than kWorldBound_m from the world's.
  bool set_pose(std::uint32_t number, const RigidPose& X_WO, const Twist& twist);

  // From the next tick on a vertex of an object that deforms moves there, in the object's frame O
  // (see DeformableMesh). False, and nothing changed, for anything else.
  bool move_vertex(std::uint32_t number, std::uint32_t vertex, const Vec3& p_O);

  // From the next tick on an object feels like that, whatever its scene says. False, and nothing
  // changed, if there is no such object, the material is not sound(), or kMaxChangedMaterials
  // others have been changed since set().
  bool set_material(std::uint32_t number, const Material& material);

  // A new tick, `time_s` after the scene was set: objects stand where their own motion has them by
  // now, or where the outside set them since the last tick. It lasts tick_s.
  void begin_tick(double time_s, double tick_s);
  [[nodiscard]] double tick_s() const { return tick_s_; }

  [[nodiscard]] std::size_t size() const { return objects_.size(); }
  [[nodiscard]] const Object& operator[](std::uint32_t number) const { return objects_[number]; }
  [[nodiscard]] std::span<const Object> objects() const { return objects_; }
  // What object `number` feels like now: the scene's material, or what set_material made of it.
  [[nodiscard]] const Material& material(std::uint32_t number) const {
    const std::uint8_t changed = changed_of_[number];
    return changed == kUnchanged ? objects_[number].material : changed_materials_[changed];
  }
  // nullptr for an object that stands still.
  [[nodiscard]] const Mover* mover_of(std::uint32_t number) const {
    return mover_of_[number] == kNoMover ? nullptr : &movers_[mover_of_[number]];
  }
  // Of an object with a mesh, as it is in this tick; in its frame O.
  [[nodiscard]] PlacedMesh mesh_O(std::uint32_t number) const {
    const Mover* const mover = mover_of(number);
    if (mover == nullptr || mover->deformable == nullptr) {
      return {.mesh = objects_[number].mesh};
    }
    return {.mesh = mover->deformable->now(), .slack_m = mover->deformable->slack_m()};
  }
  // Of an object without a mesh, where it is in this tick.
  [[nodiscard]] const Primitive& primitive_W(std::uint32_t number) const {
    const Mover* const mover = mover_of(number);
    return mover == nullptr ? objects_[number].primitive : mover->primitive_W;
  }

  // Of the surface at p_W, m/s.
  [[nodiscard]] Vec3 velocity_W(std::uint32_t number, const Vec3& p_W) const {
    const Mover* const mover = mover_of(number);
    return mover == nullptr ? Vec3{Vec3::Zero()} : mover->twist.at(p_W - mover->X_WO.translation);
  }

  [[nodiscard]] std::span<const Mover> movers() const { return {movers_.data(), mover_count_}; }
  [[nodiscard]] bool anything_moved() const { return anything_moved_; }

  [[nodiscard]] bool any_meets_proxy() const { return independent_count_ < objects_.size(); }

  // Those that the shared proxy does not meet.
  [[nodiscard]] std::span<const std::uint32_t> independent_objects() const {
    return {independent_.data(), independent_count_};
  }

  // The boxes of the objects that stand still and meet the shared proxy; empty if there are none.
  // A leaf's "triangles" are places of still_object().
  [[nodiscard]] std::span<const BvhNode> still_nodes() const {
    return {nodes_.data(), node_count_};
  }
  [[nodiscard]] std::uint32_t still_object(std::uint32_t place) const { return order_[place]; }

  // What it remembers, to bytes or back; of the same objects.
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

// A triangle of an object's mesh, where it is in this tick; world frame.
Triangle triangle_W(const SceneObjects& scene, std::uint32_t number, std::uint32_t triangle);

}  // namespace tactus::rendering
