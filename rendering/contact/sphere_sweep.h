// Sweeps a sphere along a straight line against a triangle: time of impact by travel. The candidate
// sweep, the object sweep and the feature walk use it; primitive_sweep.h does the same for
// primitives.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "rendering/geometry/triangle.h"

namespace tactus::rendering {

// The contact margin: the distances from a surface between which the proxy's centre rests. Contact
// planes put the centre at `rest_m`; a sweep ends between `inner_m` and `stop_m`; nothing brings
// the centre below `inner_m`. All are greater than the tool's radius, so that even a point never
// lies on a triangle.
struct ContactMargin {
  explicit ContactMargin(double tool_radius_m)
      : inner_m(tool_radius_m + 0.25e-6),
        stop_m(tool_radius_m + 0.375e-6),
        rest_m(tool_radius_m + 0.5e-6),
        reach_m(tool_radius_m + 0.75e-6) {}

  // The four distances of the centre from a surface, m, in rising order. Nothing brings the centre
  // below `inner_m`.
  double inner_m;
  double stop_m;
  double rest_m;
  // A surface nearer than this is in contact.
  double reach_m;
};

// The contact margins of the tool as a sphere and as a point; each object uses one of the two.
struct ContactMargins {
  explicit ContactMargins(double tool_radius_m) : sphere(tool_radius_m) {}

  // Returns the margin for an object that meets the tool as a point or as a sphere.
  [[nodiscard]] const ContactMargin& of(bool point_tool) const {
    return point_tool ? point : sphere;
  }

  // Returns true if the tool itself is a point (radius 0).
  [[nodiscard]] bool is_point() const { return sphere.reach_m <= point.reach_m; }

  ContactMargin sphere;
  ContactMargin point{0.0};
};

// A straight line of motion of the sphere's centre; its length is the caller's.
struct Sweep {
  Vec3 from = Vec3::Zero();        // m
  Vec3 direction = Vec3::UnitX();  // unit
};

// Planes with a whole segment on their front side. A sweep along the segment cannot meet what lies
// far enough behind one of them.
class SeparatingPlanes {
 public:
  SeparatingPlanes(Vec3 from, Vec3 to) : from_(std::move(from)), to_(std::move(to)) {}

  // The planes that can hold a sphere.
  static constexpr std::size_t kMost = 3;

  // Adds the plane with this unit normal that touches the segment. At most kMost planes.
  void add(const Vec3& normal) {
    normal_[count_] = normal;
    height_[count_++] = std::min(normal.dot(from_), normal.dot(to_));
  }

  // Returns true if one of the planes, or the triangle's own plane, shows that the triangle is
  // nowhere nearer to the segment than `distance` (m). False proves nothing.
  [[nodiscard]] bool keep_off(const Triangle& triangle, double distance) const {
    for (std::size_t k = 0; k < count_; ++k) {
      if (triangle.highest(normal_[k]) <= height_[k] - distance) {
        return true;
      }
    }
    const double before = triangle.height(from_);
    const double after = triangle.height(to_);
    return std::min(before, after) >= distance || std::max(before, after) <= -distance;
  }

 private:
  Vec3 from_;
  Vec3 to_;
  std::array<Vec3, kMost> normal_;
  std::array<double, kMost> height_{};
  std::size_t count_ = 0;
};

// Returns the travel, in metres, at which the sphere's centre enters the contact margin of the
// triangle, or `limit` if it does not enter before. The result is never too long, and too short by
// less than the margin's thickness. A one-sided triangle blocks a sphere in front of it, and one
// that comes to stand in front while still clear of it. `start` is triangle.nearest(sweep.from).
double travel_to_contact(const Triangle& triangle, bool one_sided, const Sweep& sweep, double limit,
                         const ContactMargin& margin, const Nearest& start);

}  // namespace tactus::rendering
