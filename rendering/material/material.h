// What a surface feels like.
#pragma once

namespace tactus::rendering {

// Melder and Harwin's friction cone: coefficients of the sticking and of the slipping state, >= 0.
struct ConeFriction {
  double static_coefficient = 0.0;
  double dynamic_coefficient = 0.0;
};

struct Material {
  double stiffness_N_per_m = 0.0;  // K of F = K (proxy - tool) - B v
  double damping_Ns_per_m = 0.0;   // B
  ConeFriction friction;
};

}  // namespace tactus::rendering
