// The point nearest to the tool that satisfies a set of plane constraints (Zilles and Salisbury, "A
// constraint-based god-object method for haptic display", IROS 1995).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/plane_solutions.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

using Plane = HalfSpace<double>;

// The minimum of |point - h|^2 over the planes. point = h + sum of pressure_m[i] * normal of plane
// active[i].
struct PlaneProjection {
  Vec3 point = Vec3::Zero();
  std::array<std::uint8_t, 3> active{};  // indices of the planes that hold the point
  std::array<double, 3>
      pressure_m{};  // Lagrange multipliers, > 0: how far each active plane pushes
  std::uint8_t active_count = 0;
  bool feasible = true;  // false: the planes contradict each other; `point` is the best found and
                         // must not be trusted
};

// Projects h on at most 255 planes. Bounded time: a fixed number of exchanges, each of seven
// closed-form solutions.
PlaneProjection project_on_planes(const Vec3& h, std::span<const Plane> planes);

}  // namespace tactus::rendering
