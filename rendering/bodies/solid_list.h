// The solids of a world in which bodies move: the bodies, and obstacles that they meet and cannot
// push.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/body_contact.h"
#include "rendering/bodies/field_contact.h"
#include "rendering/bodies/rigid_body.h"
#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// A body to be added: its description, with the hull whatever its surface is, and its surface.
struct BodyStart {
  ObjectBody body;
  // The convex parts by which it meets others, instead of the hull; none for a body of one.
  std::span<const ConvexHull> parts;
  ContactSurface surface;
  // The pose of the object at the start.
  RigidPose X_WO;
};

// An object that bodies meet and cannot push: a mesh, a field, a hull, or a half space below a
// plane.
struct BodyObstacle {
  // The mesh and the sides of it that stop bodies; frame O.
  MeshView mesh;
  Sides sides = Sides::one;
  // The surface by its distance, where there is no mesh.
  ObstacleField field;
  // The hull, where there is neither. Without vertices it is the half space y <= 0 of a frame whose
  // pose in O is given.
  ConvexHull hull;
  RigidPose plane_O;
  ContactSurface surface;
  RigidPose X_WO;
  Twist twist;

  [[nodiscard]] bool has_hull() const { return !hull.vertices_O.empty(); }
};

// Lives in static storage; no heap. Solids are numbered: first the bodies in the order in which
// they were added, then the obstacles.
class SolidList {
 public:
  static constexpr std::size_t kMostSolids = kMaxBodies + kMaxObstacles;

  // Starts over without solids.
  void clear();
  // Adds a body or an obstacle, after clear(). Returns false, and adds nothing, if there are
  // kMaxBodies or kMaxObstacles already, or the mass is not valid() or the hull has no or too many
  // vertices, or there are more than kMaxPartsOfBody or kMaxBodyParts. Its views must stay alive
  // and unchanged.
  bool add_body(const BodyStart& start);
  bool add_obstacle(const BodyObstacle& obstacle);
  // Sets the place of an obstacle, by its number among them, and whether it moves in the next tick.
  void set_obstacle(std::size_t obstacle, const RigidPose& X_WO, const Twist& twist, bool moves);

  // Returns the number of bodies, and that of all solids.
  [[nodiscard]] std::uint16_t body_count() const { return body_count_; }
  [[nodiscard]] std::uint16_t count() const {
    return static_cast<std::uint16_t>(body_count_ + obstacle_count_);
  }
  [[nodiscard]] bool is_body(std::size_t solid) const { return solid < body_count_; }

  // Returns the bodies as they are now.
  [[nodiscard]] std::span<const RigidBody> bodies() const { return {bodies_.data(), body_count_}; }
  [[nodiscard]] RigidBody& body(std::size_t number) { return bodies_[number]; }
  // Returns the bodies as they were added.
  [[nodiscard]] std::span<const BodyStart> starts() const { return {starts_.data(), body_count_}; }
  // Returns the obstacles.
  [[nodiscard]] std::span<const BodyObstacle> obstacles() const {
    return {obstacles_.data(), obstacle_count_};
  }
  // Returns the obstacle that has the number of a solid.
  [[nodiscard]] const BodyObstacle& obstacle_of(std::size_t solid) const {
    return obstacles_[solid - body_count_];
  }

  // Returns the surface of a solid.
  [[nodiscard]] const ContactSurface& surface_of(std::size_t solid) const {
    return is_body(solid) ? starts_[solid].surface : obstacle_of(solid).surface;
  }
  // Returns true for a body, and for an obstacle that is met by a hull.
  [[nodiscard]] bool has_hull(std::size_t solid) const {
    return is_body(solid) || obstacle_of(solid).has_hull();
  }
  // Returns true if a solid is an obstacle that moves in this tick, or if any is.
  [[nodiscard]] bool is_moving_obstacle(std::size_t solid) const {
    return !is_body(solid) && obstacle_moves_[solid - body_count_];
  }
  [[nodiscard]] bool any_obstacle_moves() const;
  // Returns true if any body consists of several parts.
  [[nodiscard]] bool any_parts() const { return part_count_ > 0; }
  // Returns the number of the first part of a body among the parts of all.
  [[nodiscard]] std::size_t first_part(std::size_t body) const { return first_part_[body]; }

 private:
  std::array<BodyStart, kMaxBodies> starts_;
  std::array<RigidBody, kMaxBodies> bodies_;
  std::uint16_t body_count_ = 0;
  std::array<std::uint16_t, kMaxBodies> first_part_{};
  std::size_t part_count_ = 0;
  std::array<BodyObstacle, kMaxObstacles> obstacles_;
  std::array<bool, kMaxObstacles> obstacle_moves_{};
  std::uint16_t obstacle_count_ = 0;
};

}  // namespace tactus::rendering
