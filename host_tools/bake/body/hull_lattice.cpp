#include "host_tools/bake/body/hull_lattice.h"

#include <Eigen/Geometry>
#include <cmath>

namespace tactus::host {
namespace {

// Differences of coordinates have 27 bits and a sign, and a determinant of three of them 84.
__extension__ using Wide = __int128;

constexpr double kHalfLattice = 67108864.0;  // 2^26

LatticePoint difference(const LatticePoint& a, const LatticePoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace

HullLattice::HullLattice(std::span<const Vec3> points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) {
    box.extend(p);
  }
  const Vec3 center = box.center();
  unit_m_ = 0.5 * box.sizes().maxCoeff() / kHalfLattice;
  points_.reserve(points.size());
  for (const Vec3& p : points) {
    const Vec3 units = (p - center) / unit_m_;
    points_.push_back({std::llround(units.x()), std::llround(units.y()), std::llround(units.z())});
  }
}

Vec3 HullLattice::place(std::uint32_t index) const {
  const LatticePoint& p = points_[index];
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

int HullLattice::side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
  const LatticePoint u = difference(points_[b], points_[a]);
  const LatticePoint v = difference(points_[c], points_[a]);
  const LatticePoint w = difference(points_[d], points_[a]);
  const Wide sum = static_cast<Wide>(u[1] * v[2] - u[2] * v[1]) * w[0] +
                   static_cast<Wide>(u[2] * v[0] - u[0] * v[2]) * w[1] +
                   static_cast<Wide>(u[0] * v[1] - u[1] * v[0]) * w[2];
  return sum > 0 ? 1 : (sum < 0 ? -1 : 0);
}

}  // namespace tactus::host
