// Coulomb's friction, Fc, and a viscous term: the cone of equal coefficients. It is what joints
// use.
#pragma once

#include "rendering/friction/slider.h"

namespace tactus::rendering {

struct CoulombViscousModel {
  static constexpr std::string_view kName = "coulomb";
  static constexpr std::string_view kTitle = "Coulomb and viscous";
  static constexpr bool kHasBristles = false;
  static constexpr std::array kParameters{
      &FrictionParameters::coulomb, &FrictionParameters::viscous_s_per_m,
      &FrictionParameters::stiffness_N_per_m, &FrictionParameters::damping_s_per_m,
      &FrictionParameters::damping_fade_m_per_s};

  static double steady_level(const FrictionParameters& parameters, double /*speed_m_per_s*/) {
    return parameters.coulomb;
  }

  template <typename Vector>
  static ElasticStep<Vector> advance(const FrictionParameters& parameters,
                                     const FrictionTick<Vector>& tick,
                                     const FrictionMemory<Vector>& memory) {
    const double level_N = parameters.coulomb * tick.normal_force_N;
    return advance_slider({.hold_N = level_N, .slip_N = level_N}, parameters.stiffness_N_per_m,
                          tick, memory.elastic_force_N);
  }
};

}  // namespace tactus::rendering
