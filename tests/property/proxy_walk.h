// The shared proxy of a world against brute force over all triangles that are near, under a tool
// that wanders.
#pragma once

#include <cstdint>

#include "rendering/objects/object.h"
#include "tests/support/shapes.h"

namespace tactus::testing {

struct ProxyCase {
  Shape shape;
  rendering::Sides sides;
  double radius_m;
  bool friction;
};

struct ProxyTally {
  std::size_t contacts = 0;
  std::size_t unfinished = 0;
  double worst_clearance_m = 1.0;
  double worst_descent_m = 0.0;

  void add(const ProxyTally& other);
};

// Asserts in every tick that the proxy's path crosses no triangle and comes no nearer to one than
// its radius, and, without friction, that it rests where nothing lets it come nearer to the tool.
void walk_about(const ProxyCase& c, std::uint64_t seed, std::size_t ticks, ProxyTally& tally);

}  // namespace tactus::testing
