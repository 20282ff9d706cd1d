// A triangle prepared for many distance queries. Contact measures nearly all of its distances with
// it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The part of a triangle on which a nearest point lies.
enum class Feature : std::uint8_t { face, edge, vertex };

// The point of a triangle nearest to a query point q, seen from q.
struct Nearest {
  // The distance of q from the triangle, m, >= 0.
  double distance = 0.0;
  // The unit vector from the nearest point to q; the triangle's front normal if q lies on the
  // triangle.
  Vec3 normal = Vec3::Zero();
  Feature feature = Feature::face;
  // The number of the edge, for Feature::edge; it runs from corner `edge` to the next.
  std::uint8_t edge = 0;
};

// The distance from a moving point to a triangle is a convex function of its travel along a
// straight line, and `normal` is its gradient: the sweep (rendering/contact/sphere_sweep.h) and the
// contact planes rest on these two facts.
class Triangle {
 public:
  Triangle() = default;
  // The corners, counter-clockwise seen from the front, m.
  Triangle(const Vec3& a, const Vec3& b, const Vec3& c);

  // Returns the nearest point to q. It is exact to rounding for every triangle, also one without
  // area.
  [[nodiscard]] Nearest nearest(const Vec3& q) const;

  // Returns the signed distance to the triangle's plane, m: > 0 in front (counter-clockwise side),
  // 0 for a triangle without area.
  [[nodiscard]] double height(const Vec3& q) const { return normal_.dot(q - corner_[0]); }

  // Returns the unit normal toward the front; zero for a triangle without area.
  [[nodiscard]] const Vec3& normal() const { return normal_; }

  // Returns true if q projects inside the face.
  [[nodiscard]] bool faces(const Vec3& q) const { return is_inside(inward_of(q)); }

  // Returns the largest normal . x of its points x, m.
  [[nodiscard]] double highest(const Vec3& normal) const {
    return std::max({normal.dot(corner_[0]), normal.dot(corner_[1]), normal.dot(corner_[2])});
  }

  // Returns the vector from corner k to corner k + 1, m.
  [[nodiscard]] const Vec3& edge(std::size_t k) const { return edge_[k]; }

 private:
  // Returns how far inside each edge q projects, times the edge's length.
  [[nodiscard]] std::array<double, 3> inward_of(const Vec3& q) const {
    return {inward_[0].dot(q - corner_[0]), inward_[1].dot(q - corner_[1]),
            inward_[2].dot(q - corner_[2])};
  }
  static bool is_inside(const std::array<double, 3>& inward) {
    return std::min({inward[0], inward[1], inward[2]}) > 0.0;
  }
  // Returns the nearest point to a q that projects outside the face.
  [[nodiscard]] Nearest nearest_on_border(const Vec3& q, const std::array<double, 3>& inward) const;

  std::array<Vec3, 3> corner_;
  std::array<Vec3, 3> edge_;
  // The vector in the plane perpendicular to each edge, toward the inside, as long as the edge.
  std::array<Vec3, 3> inward_;
  Vec3 normal_ = Vec3::Zero();
};

}  // namespace tactus::rendering
