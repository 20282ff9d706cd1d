// Random boxes and vectors for tests of a hierarchy's nodes.
#pragma once

#include <cstdint>
#include <random>

#include "rendering/geometry/mesh.h"

namespace tactus::testing {

class AnyBoxes {
 public:
  explicit AnyBoxes(std::uint64_t seed) : random_(seed) {}

  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  Vec3 vector() { return {2.0 * unit() - 1.0, 2.0 * unit() - 1.0, 2.0 * unit() - 1.0}; }

  // Its integers are floats that are not numbers.
  rendering::BvhNode box_at(const Vec3& corner) {
    return {.lower = rendering::to_float3(corner),
            .first = 0xffff'ffffU,
            .upper = rendering::to_float3(corner + 0.01 * (Vec3::Ones() + vector())),
            .triangle_count = 0x7fc0'0000U};
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace tactus::testing
