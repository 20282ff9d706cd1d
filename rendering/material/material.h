// The material of a surface: stiffness, damping and friction. Every object has one; set_material of
// the world may change it while the scene runs.
#pragma once

#include <cmath>

#include "rendering/friction/friction_model.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Friction that differs along and across a direction (grain.h): factors of the coefficients.
struct MaterialGrain {
  // The direction of the grain in the object's frame; not zero, its length has no meaning.
  Float3 direction_O{1.0F, 0.0F, 0.0F};
  // The factors of the coefficients for a motion along and across the grain, in [0, 1].
  double along = 1.0;
  double across = 1.0;  // in [0, 1]

  // Returns true if the grain has an effect.
  [[nodiscard]] constexpr bool differs() const { return along != 1.0 || across != 1.0; }
};

// Returns true if the direction is finite and not zero, and the factors are within their bounds.
inline bool valid(const MaterialGrain& grain) {
  const double length = to_vec3(grain.direction_O).norm();
  const auto is_factor = [](double factor) { return factor >= 0.0 && factor <= 1.0; };
  return std::isfinite(length) && length > 0.0 && is_factor(grain.along) && is_factor(grain.across);
}

// The constants of F = K (proxy - tool) - B v and of the friction.
struct Material {
  // K.
  double stiffness_N_per_m = 0.0;
  // B, for the whole velocity of the tool relative to the surface.
  double damping_Ns_per_m = 0.0;
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
