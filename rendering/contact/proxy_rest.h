// The result of the shared proxy's move in one tick: the planes that hold it, and its path. The
// steps of a tick write it (proxy_tick.cpp), and ProxyTouch makes the force of it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/geometry/plane_projection.h"
#include "rendering/geometry/triangle.h"
#include "rendering/limits.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// Numbers no candidate of the candidate set.
inline constexpr std::size_t kNoCandidate = static_cast<std::size_t>(-1);

// One contact plane: a constraint on the proxy's centre.
struct ContactPlane {
  // The half space of the proxy's centre: normal . x >= offset; world frame.
  Plane plane;
  // The nearest point of the surface, seen from the proxy; world frame.
  Nearest nearest;
  // The index of the object in the scene.
  std::uint32_t object = 0;
  // The index of the triangle in the object's mesh; 0 for a primitive.
  std::uint32_t triangle = 0;
  // The number in the candidate set, valid until that is gathered again.
  std::size_t candidate = 0;
};

// The proxy's contact after a tick.
struct ProxyRest {
  // The direction of the joint push of the planes, unit; zero in free space. It is the sum of
  // pressure times plane normal, made unit.
  Vec3 normal_W = Vec3::Zero();
  // The active planes, the first `plane_count`: those that push.
  std::array<ContactPlane, 3> planes{};
  // The pressures: how far each of them pushes the proxy from the tool, m. Times the stiffness they
  // are the forces on the planes.
  std::array<double, 3> pressure_m{};
  std::uint8_t plane_count = 0;  // number of active planes
  // The number of straight moves in this tick.
  std::uint16_t sub_goals = 0;
  // TouchFlags: the limits that the tick reached.
  std::uint32_t flags = kTouchClean;
  // The distance of the proxy from its goal when a limit ended the tick, m
  // (Touch::short_of_goal_m).
  double short_of_goal_m = 0.0;

  // Returns the index of the plane with the largest pressure. plane_count must be > 0.
  [[nodiscard]] std::size_t hardest() const {
    const auto end = pressure_m.begin() + plane_count;
    return static_cast<std::size_t>(std::max_element(pressure_m.begin(), end) - pressure_m.begin());
  }
};

// Factors of the friction coefficients of some objects, and the tool's depth. They come from
// textures and shading.
struct FrictionFactors {
  // The numbers of the objects and their factors, the first `count`.
  std::array<std::uint32_t, 3> object{};
  std::array<double, 3> factor{};
  std::size_t count = 0;
  // The tool's depth, m, if shading has set a goal that is not as deep as the tool; 0 for the
  // goal's.
  double depth_m = 0.0;

  // Returns the factor of object `number`; 1 if it has none.
  [[nodiscard]] double of(std::uint32_t number) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (object[i] == number) {
        return factor[i];
      }
    }
    return 1.0;
  }
};

}  // namespace tactus::rendering
