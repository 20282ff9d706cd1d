// Parameters of every kind of friction, passive, for tests that hold of all.
#pragma once

#include <string>
#include <vector>

#include "rendering/friction/friction_model.h"
#include "rendering/friction/lugre_passivity.h"

namespace tactus::testing {

struct NamedFriction {
  std::string name;
  rendering::FrictionParameters parameters;
};

// Prints the name in messages of GoogleTest.
inline void PrintTo(const NamedFriction& friction, std::ostream* out) {
  *out << friction.name;
}

// Returns every registered model, in the order of their numbers, with a bristle of
// `stiffness_N_per_m` and the coefficients of a fingertip on a surface; its damping fades with the
// speed, or there is enough of the viscous term.
inline std::vector<NamedFriction> every_kind(double stiffness_N_per_m) {
  rendering::FrictionParameters base{.coulomb = 0.5,
                                     .static_level = 0.8,
                                     .viscous_s_per_m = 0.3,
                                     .stribeck_velocity_m_per_s = 0.01,
                                     .stiffness_N_per_m = stiffness_N_per_m,
                                     .damping_s_per_m = 5.0,
                                     .stick_velocity_m_per_s = 1e-3,
                                     .elastic_fraction = 0.7};
  base.kind = rendering::FrictionKind::lugre;
  rendering::FrictionParameters viscous = base;
  viscous.viscous_s_per_m = lugre_passivity(base).needed_viscous_s_per_m;
  base.damping_fade_m_per_s = lugre_passivity(base).largest_fade_m_per_s;
  std::vector<NamedFriction> kinds;
  for (const rendering::FrictionModelTraits& model : rendering::kFrictionModels) {
    base.kind = model.kind;
    kinds.push_back({std::string(model.name), base});
  }
  kinds.push_back({"lugre_viscous", viscous});
  return kinds;
}

}  // namespace tactus::testing
