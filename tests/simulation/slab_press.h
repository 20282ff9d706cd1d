// The scene of the whole-loop tests: a slab, and a hand that presses on it.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "host_tools/simulation/simulation.h"
#include "tests/support/solid.h"

namespace tactus::testing {

inline constexpr double kToolRadius_m = 0.002;
inline constexpr double kStiffness_N_per_m = 800.0;
inline constexpr double kFront_m = 0.01;  // z of the slab's front face

inline Solid slab(double static_friction, double dynamic_friction, double damping_Ns_per_m = 0.0) {
  return {
      box({0.2, 0.2, 2.0 * kFront_m}), rendering::Sides::one,
      rendering::Material{.stiffness_N_per_m = kStiffness_N_per_m,
                          .damping_Ns_per_m = damping_Ns_per_m,
                          .friction = rendering::cone_friction(static_friction, dynamic_friction)}};
}

// A waypoint with the tool's surface `depth_m` below the slab's front.
inline host::Waypoint at_depth(double t_s, double x_m, double depth_m) {
  return {.t_s = t_s, .p_W = {x_m, 0.0, kFront_m + kToolRadius_m - depth_m}};
}

// Waits in front while the device homes, then presses and holds.
inline host::WishPath press(double depth_m) {
  return host::WishPath(
      {at_depth(0.0, 0.0, -0.01), at_depth(0.8, 0.0, -0.01), at_depth(1.5, 0.0, depth_m)});
}

// A hand that does not tremble, on a device whose joints have no friction: closed forms are exact.
inline host::SimulationConfig ideal(host::WishPath path) {
  host::SimulationConfig config{.path = std::move(path)};
  config.hand.tremor_m = 0.0;
  config.device.device.plant.joint_friction = {};
  return config;
}

inline void run_for(host::Simulation& simulation, double seconds) {
  const int ticks = static_cast<int>(std::lround(seconds * 1000.0));
  for (int i = 0; i < ticks; ++i) {
    simulation.tick();
  }
}

}  // namespace tactus::testing
