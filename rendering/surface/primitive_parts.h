// The common part of the primitives: what each of them says of itself, and helpers for it.
//
// A primitive is a struct in primitives/, measured in its own frame O, with
//   kName        of `primitive` in TOML
//   kDimensions  the keys of its dimensions, in the order of Primitive::dimensions_m
//   kIsConvex
//   measure      the exact signed distance and normal at a point
//   extent       the box about it
// and, if positive dimensions are not all it takes, `fits` and its condition in words, kCondition;
// if a sphere can touch it in several points at once, from outside or from within, add_contacts.
// The contacts of a convex solid are planes that touch it, whether p is within or outside. A round
// wall is touched by many: those on the side of p, of which the first is the nearest, come before
// end_round_wall().
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The number of a primitive in registered_primitives.h, which images store. These are the numbers
// that the code itself uses by name.
enum class PrimitiveKind : std::uint8_t {
  plane = 0,
  sphere = 1,
  box = 2,
  cylinder = 3,
  capsule = 4,
  cone = 5,
  torus = 6,
};

using PrimitiveDimensions = std::array<double, 3>;  // m

// A key of dimensions in TOML. It is a number, or three in brackets.
struct DimensionKey {
  std::string_view key;
  double factor = 1.0;    // the stored dimension over the number in TOML: 0.5 for a height about 0
  std::size_t count = 1;  // of numbers: 1 or 3
};

// The distance from a point to a surface, and the nearest point's normal, in frame O.
struct Measure {
  double distance_m;
  Vec3 normal_O;
};

// The points in which a sphere about p may touch a solid: at most kMost, in any order.
class Contacts {
 public:
  static constexpr std::size_t kMost = 8;

  void add(const Measure& measure) { measures_[count_++] = measure; }
  // Says that the contacts so far are with one round wall, the first of them on the side of p.
  void end_round_wall() { round_count_ = count_; }

  [[nodiscard]] std::span<const Measure> all() const { return {measures_.data(), count_}; }
  [[nodiscard]] std::size_t round_count() const { return round_count_; }

 private:
  std::array<Measure, kMost> measures_{};
  std::size_t count_ = 0;
  std::size_t round_count_ = 0;
};

struct Bounds {
  Vec3 lower_W = Vec3::Zero();  // m
  Vec3 upper_W = Vec3::Zero();

  // Returns the distance from p_W to the box, m; 0 inside.
  [[nodiscard]] double distance(const Vec3& p_W) const {
    return (p_W - p_W.cwiseMax(lower_W).cwiseMin(upper_W)).norm();
  }
};

// Below this a length has no direction that division would give exactly.
inline constexpr double kNoLength_m = 1e-150;

inline double sign_of(double x) {
  return x < 0.0 ? -1.0 : 1.0;
}

// Returns the box that reaches `half` to both sides of the origin of O.
inline Bounds about_origin(const RigidPose& X_WO, const Vec3& half) {
  return {.lower_W = X_WO.translation - half, .upper_W = X_WO.translation + half};
}

// Half the extent along x, y and z of a disc about the unit axis.
inline Vec3 disc_extent(const Vec3& axis, double radius) {
  return radius * (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
}

// Returns six unit vectors across the y axis, 60 degrees apart, the first toward p. A sphere in a
// round hole touches it in all directions, of which these are enough to hold it.
inline std::array<Vec3, 6> round_the_axis(const Vec3& p) {
  const double r = std::sqrt(p.x() * p.x() + p.z() * p.z());
  const Vec3 first = r > kNoLength_m ? Vec3{p.x() / r, 0.0, p.z() / r} : Vec3::UnitX();
  const Vec3 across{-first.z(), 0.0, first.x()};
  constexpr double kHalfRoot3 = 0.86602540378443865;
  const Vec3 half = 0.5 * first;
  const Vec3 side = kHalfRoot3 * across;
  return {first, half + side, side - half, -first, -half - side, half - side};
}

using ProfilePoint = Eigen::Vector2d;

// A measure in the half plane (r, y) that holds the point, r its distance from the axis.
struct ProfileMeasure {
  double distance_m;
  ProfilePoint normal;
};

// Measures a solid of revolution about y in that half plane: the mirrored half never has a nearer
// surface point. `profile` measures a point (r, y).
template <class Profile>
Measure revolve(const Vec3& p, const Profile& profile) {
  const double r = std::sqrt(p.x() * p.x() + p.z() * p.z());
  const Vec3 outward = r > kNoLength_m ? Vec3{p.x() / r, 0.0, p.z() / r} : Vec3::UnitX();
  const ProfileMeasure flat = profile(ProfilePoint(r, p.y()));
  return {flat.distance_m, flat.normal.x() * outward + flat.normal.y() * Vec3::UnitY()};
}

}  // namespace tactus::rendering
