#include "rendering/bodies/simplex.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

namespace tactus::rendering {
namespace {

using Shares = std::array<double, 4>;

// Return the shares of the corners in the point of a line or a plane that is nearest to the origin,
// if that lies between the corners and they do not coincide.
std::optional<Shares> shares_of(const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double along = -a.dot(ab);
  const bool is_between = along > 0.0 && along < length2;
  if (!is_between) {
    return std::nullopt;
  }
  const double t = along / length2;
  return Shares{1.0 - t, t};
}

std::optional<Shares> shares_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  const double at_a = normal.dot(b.cross(c));
  const double at_b = normal.dot(c.cross(a));
  const double at_c = normal.dot(a.cross(b));
  const double sum = at_a + at_b + at_c;
  const bool is_inside = area2 > 0.0 && at_a > 0.0 && at_b > 0.0 && at_c > 0.0;
  if (!is_inside) {
    return std::nullopt;
  }
  return Shares{at_a / sum, at_b / sum, at_c / sum};
}

// Returns true if the origin is within the tetrahedron, which is not flat.
bool holds_origin(const std::array<Vec3, 4>& p) {
  const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a);
  };
  const Vec3 o = Vec3::Zero();
  const double whole = volume(p[0], p[1], p[2], p[3]);
  const double sign = whole > 0.0 ? 1.0 : -1.0;
  return whole != 0.0 && sign * volume(o, p[1], p[2], p[3]) > 0.0 &&
         sign * volume(p[0], o, p[2], p[3]) > 0.0 && sign * volume(p[0], p[1], o, p[3]) > 0.0 &&
         sign * volume(p[0], p[1], p[2], o) > 0.0;
}

}  // namespace

Vec3 Simplex::nearest() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    sum += shares[i] * points[i];
  }
  return sum;
}

bool reduce_to_nearest(Simplex& simplex, std::array<std::size_t, 4>& kept) {
  kept = {0, 1, 2, 3};
  if (simplex.count == 4 && holds_origin(simplex.points)) {
    return true;
  }
  Simplex best;
  double least = std::numeric_limits<double>::infinity();
  const auto subsets = std::uint32_t{1} << simplex.count;
  for (std::uint32_t subset = 1; subset < subsets; ++subset) {
    const int size = std::popcount(subset);
    if (size > 3) {
      continue;
    }
    Simplex part;
    std::array<std::size_t, 4> numbers{};
    for (std::size_t i = 0; i < simplex.count; ++i) {
      if ((subset >> i & 1U) != 0) {
        numbers[part.count] = i;
        part.points[part.count++] = simplex.points[i];
      }
    }
    const auto& p = part.points;
    const std::optional<Shares> shares = size == 1   ? Shares{1.0}
                                         : size == 2 ? shares_of(p[0], p[1])
                                                     : shares_of(p[0], p[1], p[2]);
    if (!shares.has_value()) {
      continue;
    }
    part.shares = *shares;
    const double distance2 = part.nearest().squaredNorm();
    if (distance2 < least) {
      least = distance2;
      best = part;
      kept = numbers;
    }
  }
  simplex = best;
  return false;
}

}  // namespace tactus::rendering
