// The result of the shared proxy's move in one tick: the planes that hold it, and its path.
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

// The sub-goals that the proxy reached in one tick, for tests and pictures: points[0] to
// points[count - 1], world frame, metres.
struct ProxyPath {
  std::array<Vec3, kMaxSubGoals + 1> points;
  std::size_t count = 0;
};

// One contact plane: a constraint on the proxy's centre.
struct ContactPlane {
  Plane plane;                 // world frame; the centre must stay on its positive side
  Nearest nearest;             // point of the surface nearest to the proxy; world frame
  std::uint32_t object = 0;    // index of the object in the scene
  std::uint32_t triangle = 0;  // index in the object's mesh; 0 for a primitive
  std::size_t candidate = 0;   // number in the candidate set, until it is gathered again
};

// The proxy's contact after a tick.
struct ProxyRest {
  Vec3 normal_W = Vec3::Zero();  // unit, of the joint push of the planes; zero in free space
  std::array<ContactPlane, 3> planes{};  // the active planes: those that push
  std::array<double, 3> pressure_m{};    // how far each of them pushes the proxy from the tool
  std::uint8_t plane_count = 0;          // number of active planes
  std::uint16_t sub_goals = 0;           // number of straight moves in this tick
  std::uint32_t flags = kTouchClean;     // TouchFlags

  // Returns the index of the plane with the largest pressure. plane_count must be > 0.
  [[nodiscard]] std::size_t hardest() const {
    const auto end = pressure_m.begin() + plane_count;
    return static_cast<std::size_t>(std::max_element(pressure_m.begin(), end) - pressure_m.begin());
  }
};

// Factors of the friction coefficients of some objects, and the tool's depth (m) if the goal is not
// as deep as the tool. They come from textures and shading.
struct FrictionFactors {
  std::array<std::uint32_t, 3> object{};
  std::array<double, 3> factor{};
  std::size_t count = 0;
  double depth_m = 0.0;  // 0: the goal's

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
