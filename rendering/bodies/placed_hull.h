// A convex hull at its place in a tick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/geometry/convex_hull.h"
#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// A hull at its place in a tick.
class PlacedHull {
 public:
  PlacedHull() = default;
  // Takes the hull, which stays alive and has 1 to kMaxHullVertices vertices, to a pose.
  void place(const ConvexHull& hull, const RigidPose& X_WO);
  // Takes the middle and the reach of all hulls together, at least one; it has no vertices then.
  void enclose(std::span<const PlacedHull> hulls);

  // Returns the vertices, world frame, m.
  [[nodiscard]] std::span<const Vec3> vertices_W() const { return {vertices_W_.data(), count_}; }
  [[nodiscard]] const ConvexHull& hull() const { return hull_; }
  // Returns the outward normal of a face, world frame.
  [[nodiscard]] Vec3 normal_W(std::size_t face) const {
    return face < kKeptNormals ? normals_W_[face] : Vec3{rotation_ * hull_.faces[face].normal_O};
  }
  // Returns the numbers of a face's corners.
  [[nodiscard]] std::span<const std::uint8_t> corners(std::size_t face) const {
    const HullFace& polygon = hull_.faces[face];
    return hull_.corners.subspan(polygon.first, polygon.count);
  }
  // The points in which the circles of a round solid may touch a plane; world frame, m.
  struct RimPoints {
    std::array<Vec3, 8> points;
    std::size_t count = 0;
    // True if the plane lies along the line between the lowest points of the two circles.
    bool is_along_side = false;
  };
  // Returns them, for a plane with this unit normal toward the solid: of each circle the lowest
  // one, which comes first, and three that share the circle with it; of a tip itself. The solid
  // must have circles.
  [[nodiscard]] RimPoints rim_points(const Vec3& normal_W) const;
  // Returns the number of the vertex that is farthest along a direction; the first of several.
  [[nodiscard]] std::size_t support(const Vec3& direction_W) const;
  // Returns the middle of the vertices' box, and the distance of the farthest point of the solid
  // from it, m.
  [[nodiscard]] const Vec3& middle_W() const { return middle_W_; }
  [[nodiscard]] double reach_m() const { return reach_m_; }
  // Returns the half sides of the vertices' box, m.
  [[nodiscard]] const Vec3& half_W() const { return half_W_; }

 private:
  ConvexHull hull_;
  Mat3 rotation_ = Mat3::Identity();
  Vec3 translation_ = Vec3::Zero();
  std::array<Vec3, kMaxHullVertices> vertices_W_;
  std::size_t count_ = 0;
  // The normals of the first faces: all of a box.
  static constexpr std::size_t kKeptNormals = 8;
  std::array<Vec3, kKeptNormals> normals_W_;
  Vec3 middle_W_ = Vec3::Zero();
  Vec3 half_W_ = Vec3::Zero();
  double reach_m_ = 0.0;
};

// Returns true if the spheres about two hulls are farther apart than the margin.
[[nodiscard]] inline bool are_apart(const PlacedHull& a, const PlacedHull& b, double margin_m) {
  const double reach_m = a.reach_m() + b.reach_m() + margin_m;
  return (a.middle_W() - b.middle_W()).squaredNorm() > reach_m * reach_m;
}

}  // namespace tactus::rendering
