// Places on a grid, for searches through a box.
#pragma once

#include "rendering/geometry/vector.h"

namespace tactus::host {

// Returns point `i` of a grid of side^3 points over the unit cube, x first.
inline Vec3 grid_share(int i, int side) {
  const int column = i % side;
  const int row = i / side % side;
  const int layer = i / side / side;
  return Vec3(column, row, layer) / (side - 1);
}

}  // namespace tactus::host
