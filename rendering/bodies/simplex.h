// The point of a simplex that is nearest to the origin.
#pragma once

#include <array>
#include <cstddef>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Up to four points, and the shares with which they make the nearest point.
struct Simplex {
  std::array<Vec3, 4> points;
  std::array<double, 4> shares{};
  std::size_t count = 0;

  // Returns the point that the shares make.
  [[nodiscard]] Vec3 nearest() const;
};

// Finds the point of the simplex's hull that is nearest to the origin, keeps the points that make
// it, in their order, with shares > 0 that add up to one, and says in `kept` which they are. The
// nearest of all corners, edges and faces is taken: no branch can choose a wrong one by rounding.
// Returns true if the origin lies within a tetrahedron, which is then kept whole.
bool reduce_to_nearest(Simplex& simplex, std::array<std::size_t, 4>& kept);

}  // namespace tactus::rendering
