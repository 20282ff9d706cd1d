// Points rounded to whole numbers, in which the side of a plane is decided exactly. A step of
// convex_hull.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rendering/geometry/vector.h"

namespace tactus::host {

// The coordinates of a point in units of the lattice.
using LatticePoint = std::array<std::int64_t, 3>;

// A cubic lattice about the box of some points. The longest side of the box has 2^27 units, so that
// rounding moves a point far less than storing it as a float.
class HullLattice {
 public:
  // The points must be finite, and not all at one place.
  explicit HullLattice(std::span<const Vec3> points);

  [[nodiscard]] const LatticePoint& point(std::uint32_t index) const { return points_[index]; }
  // Returns the place of a point in units of the lattice.
  [[nodiscard]] Vec3 place(std::uint32_t index) const;
  // Returns the length of a unit, m.
  [[nodiscard]] double unit_m() const { return unit_m_; }

  // Returns 1 if d is on the side of the plane through a, b and c from which they turn
  // counter-clockwise, -1 if it is on the other, and 0 if it is in the plane.
  [[nodiscard]] int side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;

 private:
  double unit_m_;
  std::vector<LatticePoint> points_;
};

}  // namespace tactus::host
