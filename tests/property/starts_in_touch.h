// A tool that begins in touch with a mesh and moves away, against brute force over all triangles
// that are near.
#pragma once

#include <cstdint>

#include "rendering/geometry/mesh.h"
#include "tests/support/shapes.h"

namespace tactus::testing {

struct StartCase {
  const Shape& shape;
  rendering::Sides sides;
  double radius_m;  // > 0
  double friction;
};

struct StartTally {
  std::size_t starts = 0;  // that overlapped the surface
  std::size_t ended = 0;   // and came away without meeting it again
};

// Starts about the surface, half of them on the other side, and goes away on straight ways that
// tremble. Asserts that the tool feels nothing, and has its proxy with it, until no triangle is
// within its radius, and at the end again.
void leave_from(const StartCase& c, std::uint64_t seed, std::size_t starts, StartTally& tally);

}  // namespace tactus::testing
