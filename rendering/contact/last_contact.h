// The contact that held the proxy last.
#pragma once

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

}  // namespace tactus::rendering
