// The planes by which a tool holds bodies in a tick: the touch writes them, and the bodies' step
// gives each its force.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/bodies/finger_grip.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// A plane of the contact of a tool with an object that is a body.
struct ToolGrip {
  // The number of the object in the scene; grip.body is the step's.
  std::uint32_t object = 0;
  FingerGrip grip;
  // The force on the hand, N, world frame: of the step.
  Vec3 force_W = Vec3::Zero();
};

// All of one tool in one tick.
struct ToolGrips {
  std::array<ToolGrip, kGripsOfTool> grips;
  std::size_t count = 0;
  // The force of the shared proxy in the touch, N, and the part of it that is not of bodies.
  Vec3 proxy_force_W = Vec3::Zero();
  Vec3 other_force_W = Vec3::Zero();

  // Returns the force on the hand with the bodies' forces in place of what the touch took for them;
  // `touch_force_W` is the touch's, with all that acts beside the shared proxy.
  [[nodiscard]] Vec3 with_bodies(const Vec3& touch_force_W) const {
    Vec3 force = touch_force_W - proxy_force_W + other_force_W;
    for (std::size_t i = 0; i < count; ++i) {
      force += grips[i].force_W;
    }
    return force;
  }
};

}  // namespace tactus::rendering
