// A damper resists a tool that leaves a surface, but a surface does not hold the tool.
#pragma once

#include <algorithm>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Returns the force of a contact without its pull into the surface, that is with no component
// against the unit normal. The removal is passive: it only lessens the work of a spring that
// relaxes.
inline Vec3 without_pull(const Vec3& force, const Vec3& normal) {
  return force - std::min(force.dot(normal), 0.0) * normal;
}

}  // namespace tactus::rendering
