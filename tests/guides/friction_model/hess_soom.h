// The model of Hess and Soom ("Friction at a lubricated line contact operating at oscillating
// sliding velocities", J. Tribology 112(1), 1990): Coulomb's friction and a viscous term, with a
// level that falls with the speed as
//   g(v) = Fc + (Fs - Fc) / (1 + (v/vs)^2).
#pragma once

#include "rendering/friction/slider.h"

namespace tactus::rendering {

struct HessSoomModel {
  static constexpr std::string_view kName = "hess_soom";
  static constexpr std::string_view kTitle = "Hess and Soom";
  static constexpr bool kHasBristles = false;
  static constexpr std::array kParameters{&FrictionParameters::coulomb,
                                          &FrictionParameters::static_level,
                                          &FrictionParameters::viscous_s_per_m,
                                          &FrictionParameters::stribeck_velocity_m_per_s,
                                          &FrictionParameters::stiffness_N_per_m,
                                          &FrictionParameters::damping_s_per_m,
                                          &FrictionParameters::damping_fade_m_per_s};

  static double steady_level(const FrictionParameters& parameters, double speed_m_per_s) {
    const double ratio = speed_m_per_s / parameters.stribeck_velocity_m_per_s;
    return parameters.coulomb +
           (parameters.static_level - parameters.coulomb) / (1.0 + ratio * ratio);
  }

  template <typename Vector>
  static ElasticStep<Vector> advance(const FrictionParameters& parameters,
                                     const FrictionTick<Vector>& tick,
                                     const FrictionMemory<Vector>& memory) {
    const double level_N = steady_level(parameters, tick.speed_m_per_s) * tick.normal_force_N;
    return advance_slider({.hold_N = level_N, .slip_N = level_N}, parameters.stiffness_N_per_m,
                          tick, memory.elastic_force_N);
  }
};

}  // namespace tactus::rendering
