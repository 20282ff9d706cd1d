// The parameters of the friction models and what a model remembers.
//
// Normal force. The levels Fc and Fs, the bristle damping sigma1 and the viscous term sigma2 are
// per newton of it; where none is given it is 1 N and they are N and N s/m. The bristle stiffness
// sigma0 is not: a load that grows adds no tangential force by itself (Mindlin and Deresiewicz, J.
// Applied Mechanics 20, 1953), just as a stuck proxy does not move when it is pressed. So a
// changing load stores no energy: sigma0 z^2/2 does not know it, and what a falling load makes of
// it is lost with the force, which is cut to Fs N.
#pragma once

#include <cstdint>

#include "rendering/friction/tangent.h"

namespace tactus::rendering {

// The number of a model in registered_models.h, which images and recordings store. These are the
// numbers that the code itself uses by name; kFrictionKindOf<Model> is the number of any model.
enum class FrictionKind : std::uint8_t {
  cone = 0,
  coulomb_viscous = 1,
  stribeck = 2,
  karnopp = 3,
  dahl = 4,
  lugre = 5,
  elasto_plastic = 6,
};

// The normal force where none is given, as in a joint.
inline constexpr double kNoNormalForce_N = 1.0;

// A model uses those that it lists in kParameters.
struct FrictionParameters {
  FrictionKind kind = FrictionKind::cone;
  double coulomb = 0.0;          // Fc, N per N of normal force
  double static_level = 0.0;     // Fs, the same; >= coulomb
  double viscous_s_per_m = 0.0;  // sigma2, N s/m per N
  // g(v) = Fc + (Fs - Fc) exp(-(v/vs)^alpha)
  double stribeck_velocity_m_per_s = 1e-3;  // vs > 0
  double stribeck_exponent = 2.0;           // alpha > 0
  // sigma0. A model without bristles sticks by it as by a spring, and 0 means rigid. > 0 for a
  // model with bristles.
  double stiffness_N_per_m = 0.0;
  // sigma1, N s/m per N. A model without bristles has it while it sticks, so that a mass that stops
  // does not ring on its spring.
  double damping_s_per_m = 0.0;
  // v_d: sigma1 fades as exp(-(v/v_d)^2); 0 means that it does not.
  double damping_fade_m_per_s = 0.0;
  double stick_velocity_m_per_s = 1e-3;  // karnopp: below it a slip ends; > 0
  double elastic_fraction = 0.7;         // elasto_plastic: z_ba sigma0 / Fc, in (0, 1)
};

// Returns true if a surface with these parameters resists sliding at all.
inline bool has_friction(const FrictionParameters& friction) {
  return friction.static_level > 0.0 || friction.coulomb > 0.0 || friction.viscous_s_per_m > 0.0;
}

// The state of a model. FrictionMemory{} is its initial value: a new contact starts without force,
// so that it cannot kick.
template <typename Vector>
struct FrictionMemory {
  Vector elastic_force_N = zero_tangent<Vector>();  // sigma0 z
  bool slipping = false;
  bool left_band = false;  // of karnopp: the slip has been faster than stick_velocity_m_per_s
};

}  // namespace tactus::rendering
