// Shapes and a tool path that the property tests of the proxy share.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/shapes.h"

namespace tactus::testing {

// Returns closed, open, acute, thin, slivered, doubled and self-intersecting shapes.
std::vector<Shape> wandered_shapes();

// A tool that wanders about the shape: it picks points near the surface, on either side, and goes
// there at speeds from a micrometre to half the shape a tick, trembling.
class Wanderer {
 public:
  Wanderer(const Shape& shape, std::uint64_t seed) : shape_(shape), random_(seed) {}

  Vec3 next();

  static Vec3 start() { return {0.0, 0.2, 0.011}; }

 private:
  void choose_target();

  const Shape& shape_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
  std::uniform_real_distribution<double> signed_unit_{-1.0, 1.0};
  Vec3 tool_ = start();
  Vec3 target_ = start();
  double speed_ = 1e-3;
  int ticks_left_ = 0;
};

}  // namespace tactus::testing
