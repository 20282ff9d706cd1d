// Unit vectors in four bytes (Cigolle and others, "A survey of efficient representations for
// independent unit vectors", JCGT 3(2), 2014): the octahedron unfolded onto a square. At most 7e-5
// rad off.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// A unit vector in the layout of the baked image: its place on the unfolded octahedron, -1 to 1 in
// steps of 1 / kOctahedralUnit. Every value is a direction.
struct OctahedralNormal {
  std::int16_t x = 0;
  std::int16_t y = 0;

  bool operator==(const OctahedralNormal&) const = default;
};
static_assert(sizeof(OctahedralNormal) == 4);

inline constexpr double kOctahedralUnit = 32767.0;

// Returns the unit vector.
inline Vec3 decode(const OctahedralNormal& stored) {
  const double x = std::max(stored.x / kOctahedralUnit, -1.0);
  const double y = std::max(stored.y / kOctahedralUnit, -1.0);
  const double z = 1.0 - std::abs(x) - std::abs(y);
  // The corners of the square are the lower half of the octahedron: they are folded back.
  const double fold = std::max(-z, 0.0);
  return Vec3(x >= 0.0 ? x - fold : x + fold, y >= 0.0 ? y - fold : y + fold, z).normalized();
}

// Returns a stored direction within 7e-5 rad of the unit vector `n`.
inline OctahedralNormal encode(const Vec3& n) {
  // The octahedron |x| + |y| + |z| = 1; its lower half is folded outwards over the corners of the
  // square.
  const double sum = n.cwiseAbs().sum();
  double x = n.x() / sum;
  double y = n.y() / sum;
  if (n.z() < 0.0) {
    const double folded_x = (1.0 - std::abs(y)) * (x >= 0.0 ? 1.0 : -1.0);
    y = (1.0 - std::abs(x)) * (y >= 0.0 ? 1.0 : -1.0);
    x = folded_x;
  }
  const auto rounded = [](double v) {
    return static_cast<std::int16_t>(std::floor(v * kOctahedralUnit + 0.5));
  };
  return {.x = rounded(x), .y = rounded(y)};
}

}  // namespace tactus::rendering
