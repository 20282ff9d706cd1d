// The contacts that one tick leaves to the next.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "rendering/geometry/vector.h"
#include "rendering/objects/object.h"

namespace tactus::rendering {

// The contact that held the proxy last.
struct LastContact {
  std::uint32_t object = kNoObject;
  // The triangle of its mesh; 0 for a primitive.
  std::uint32_t triangle = 0;
  // The direction of the joint push of all that held the proxy, unit; zero if it is not known.
  Vec3 normal_W = Vec3::Zero();
};

// The surfaces that held the proxy when the last tick ended; unused entries have no object.
struct HeldBy {
  struct Surface {
    std::uint32_t object = kNoObject;
    // The triangle of its mesh; 0 for a primitive.
    std::uint32_t triangle = 0;

    bool operator==(const Surface&) const = default;
  };
  std::array<Surface, 3> surfaces{};

  // Returns true if the surface is one of them.
  [[nodiscard]] bool has(const Surface& surface) const {
    return std::ranges::find(surfaces, surface) != surfaces.end();
  }
};

}  // namespace tactus::rendering
