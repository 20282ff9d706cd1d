// Coulomb's friction with Stribeck's curve g(v), which falls from Fs to Fc with the speed, and a
// viscous term.
#pragma once

#include "rendering/friction/levels.h"
#include "rendering/friction/slider.h"

namespace tactus::rendering {

struct StribeckModel {
  static constexpr std::string_view kName = "stribeck";
  static constexpr std::string_view kTitle = "Stribeck";
  static constexpr bool kHasBristles = false;
  static constexpr std::array kParameters{
      &FrictionParameters::coulomb,           &FrictionParameters::static_level,
      &FrictionParameters::viscous_s_per_m,   &FrictionParameters::stribeck_velocity_m_per_s,
      &FrictionParameters::stribeck_exponent, &FrictionParameters::stiffness_N_per_m,
      &FrictionParameters::damping_s_per_m,   &FrictionParameters::damping_fade_m_per_s};

  static double steady_level(const FrictionParameters& parameters, double speed_m_per_s) {
    return falling_with_speed(parameters, speed_m_per_s);
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
