// The point nearest to the tool that satisfies a set of plane constraints (Zilles and Salisbury, "A
// constraint-based god-object method for haptic display", IROS 1995). The proxy's sub-goals, the
// carrying of the proxy and the tracking of implicit surfaces use it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/plane_solutions.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// A plane constraint in double precision: normal . x >= offset.
using Plane = HalfSpace<double>;

// The minimum of |point - h|^2 over the planes. point = h + sum of pressure_m[i] * normal of plane
// active[i].
struct PlaneProjection {
  // The nearest point, in the frame of the planes, m.
  Vec3 point = Vec3::Zero();
  // The indices of the planes that hold the point, the first `active_count`.
  std::array<std::uint8_t, 3> active{};
  std::array<double, 3>
      pressure_m{};  // Lagrange multipliers, > 0: how far each active plane pushes
  std::uint8_t active_count = 0;
  // False if the planes contradict each other: `point` is then the best found and must not be
  // trusted.
  bool feasible = true;
};

// Projects h on at most 255 planes. Bounded time: a fixed number of exchanges, each of seven
// closed-form solutions.
PlaneProjection project_on_planes(const Vec3& h, std::span<const Plane> planes);

}  // namespace tactus::rendering
