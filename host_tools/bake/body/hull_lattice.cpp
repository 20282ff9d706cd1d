#include "host_tools/bake/body/hull_lattice.h"

#include <Eigen/Geometry>
#include <cmath>

namespace tactus::host {
namespace {

// A sum of products of a minor and a difference, exact in 64-bit numbers, which every processor
// has. Differences of coordinates have 27 bits and a sign, minors of two of them 55, and a
// determinant 84: so a minor is taken in two parts.
class WideSum {
 public:
  void add(std::int64_t minor, std::int64_t difference) {
    upper_ += (minor >> kLowerBits) * difference;
    lower_ += (minor & kLowerMask) * difference;
  }

  // Returns 1, 0 or -1.
  [[nodiscard]] int sign() const {
    const std::int64_t upper = upper_ + (lower_ >> kLowerBits);
    if (upper < 0) {
      return -1;
    }
    return upper > 0 || (lower_ & kLowerMask) > 0 ? 1 : 0;
  }

 private:
  static constexpr int kLowerBits = 28;
  static constexpr std::int64_t kLowerMask = (std::int64_t{1} << kLowerBits) - 1;

  std::int64_t upper_ = 0;  // in units of 2^28
  std::int64_t lower_ = 0;
};

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
  WideSum determinant;
  determinant.add(u[1] * v[2] - u[2] * v[1], w[0]);
  determinant.add(u[2] * v[0] - u[0] * v[2], w[1]);
  determinant.add(u[0] * v[1] - u[1] * v[0], w[2]);
  return determinant.sign();
}

}  // namespace tactus::host
