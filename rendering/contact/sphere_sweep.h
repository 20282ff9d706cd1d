// How far a sphere can travel along a straight line before it touches a triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "rendering/geometry/triangle.h"

namespace tactus::rendering {

// The contact margin round a surface within which the proxy's centre rests. Contact planes put it
// at `rest`; a sweep lets it come down to between `inner` and `stop`; nothing lets it below
// `inner`. All are greater than the tool's radius, so that even a point never lies on a triangle.
struct ContactMargin {
  explicit ContactMargin(double tool_radius_m)
      : inner_m(tool_radius_m + 0.25e-6),
        stop_m(tool_radius_m + 0.375e-6),
        rest_m(tool_radius_m + 0.5e-6),
        reach_m(tool_radius_m + 0.75e-6) {}

  double inner_m;
  double stop_m;
  double rest_m;
  double reach_m;  // a triangle nearer than this is in contact
};

// The tool as each object takes it: a sphere, or its centre alone.
struct ContactMargins {
  explicit ContactMargins(double tool_radius_m) : sphere(tool_radius_m) {}

  [[nodiscard]] const ContactMargin& of(bool point_tool) const {
    return point_tool ? point : sphere;
  }

  // Whether the tool is one by itself.
  [[nodiscard]] bool is_point() const { return sphere.reach_m <= point.reach_m; }

  ContactMargin sphere;
  ContactMargin point{0.0};
};

struct Sweep {
  Vec3 from = Vec3::Zero();        // m
  Vec3 direction = Vec3::UnitX();  // unit
};

// Planes that have the whole of a way on their front side: what lies far enough behind one of them
// is not met.
class SeparatingPlanes {
 public:
  SeparatingPlanes(Vec3 from, Vec3 to) : from_(std::move(from)), to_(std::move(to)) {}

  static constexpr std::size_t kMost = 3;

  // A plane with the unit normal, as near to the way as can be; kMost in all.
  void add(const Vec3& normal) {
    normal_[count_] = normal;
    height_[count_++] = std::min(normal.dot(from_), normal.dot(to_));
  }

  // Whether one of them, or the triangle's own, shows that the triangle is nowhere nearer to the
  // way than `distance`. False tells nothing.
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

// Travel in metres at which the sphere's centre enters the contact margin of the triangle, or
// `limit` if it does not do so before. Never too long, and too short only by the contact margin's
// thickness. A one-sided triangle stops what stands in front of it, and what comes to stand in
// front of it while still clear of it. `start` is triangle.nearest(sweep.from).
double travel_to_contact(const Triangle& triangle, bool one_sided, const Sweep& sweep, double limit,
                         const ContactMargin& margin, const Nearest& start);

}  // namespace tactus::rendering
