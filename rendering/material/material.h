// The material of a surface: stiffness, damping and friction.
#pragma once

#include <cmath>

#include "rendering/friction/friction_model.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Friction that differs along and across a direction (grain.h): factors of the coefficients.
struct MaterialGrain {
  Float3 direction_O{1.0F, 0.0F, 0.0F};  // in the object's frame; not zero
  double along = 1.0;                    // in [0, 1]
  double across = 1.0;                   // in [0, 1]

  [[nodiscard]] constexpr bool differs() const { return along != 1.0 || across != 1.0; }
};

// Returns true if the direction is finite and not zero, and the factors are within their bounds.
inline bool valid(const MaterialGrain& grain) {
  const double length = to_vec3(grain.direction_O).norm();
  const auto is_factor = [](double factor) { return factor >= 0.0 && factor <= 1.0; };
  return std::isfinite(length) && length > 0.0 && is_factor(grain.along) && is_factor(grain.across);
}

struct Material {
  double stiffness_N_per_m = 0.0;  // K of F = K (proxy - tool) - B v
  double damping_Ns_per_m = 0.0;   // B
  FrictionParameters friction;
  MaterialGrain grain;
};

// Returns true if a contact can be computed with the material: stiffness and damping finite and not
// negative, friction and grain valid.
inline bool sound(const Material& material) {
  const auto is_coefficient = [](double value) { return std::isfinite(value) && value >= 0.0; };
  return is_coefficient(material.stiffness_N_per_m) && is_coefficient(material.damping_Ns_per_m) &&
         valid(material.friction) && valid(material.grain);
}

}  // namespace tactus::rendering
