// The friction cone (Melder and Harwin, "Extending the friction cone algorithm for arbitrary
// polygon based haptic objects", Haptic Interfaces for Virtual Environment and Teleoperator
// Systems, 2004).
//
// A cone of half angle atan(mu) stands on the tool with its axis along the contact normal; it cuts
// the surface in a circle of radius R = mu * depth about the point p_s that the proxy would take
// without friction. While the proxy lies within the circle of the static coefficient it sticks.
// Outside, it slips: it is drawn to the rim of the circle of the dynamic coefficient, and sticks
// again when it finds itself within that circle.
#pragma once

#include "rendering/friction/friction_parameters.h"
#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// Circle radii in metres: coefficient times depth; for several planes the sum over them.
struct FrictionCircle {
  double static_radius_m = 0.0;
  double dynamic_radius_m = 0.0;

  // Adds the circle of a surface that is pushed `push_m` deep.
  void add(const FrictionParameters& friction, double push_m) {
    static_radius_m += friction.static_level * push_m;
    dynamic_radius_m += friction.coulomb * push_m;
  }
};

struct FrictionStep {
  Vec3 goal = Vec3::Zero();  // where the proxy may go: itself when it sticks
  FrictionState state = FrictionState::stick;
};

// Evaluates the state machine of stick and slip once. `proxy` and `frictionless` (p_s) are in any
// one frame, metres; `state` is the state before.
FrictionStep apply_cone(const Vec3& proxy, const Vec3& frictionless, const FrictionCircle& circle,
                        FrictionState state);

}  // namespace tactus::rendering
