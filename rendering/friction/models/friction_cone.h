// The friction cone of Melder and Harwin (2004): sticks up to Fs, and slips at Fc until it is
// turned back. Here is the model that runs where a surface has a grain, and in a joint; a proxy
// without a grain is held by the exact rule of friction/cone.h.
#pragma once

#include "rendering/friction/levels.h"
#include "rendering/friction/slider.h"

namespace tactus::rendering {

struct FrictionConeModel {
  static constexpr std::string_view kName = "cone";
  static constexpr std::string_view kTitle = "friction cone";
  static constexpr bool kHasBristles = false;
  static constexpr std::array kParameters{&FrictionParameters::coulomb,
                                          &FrictionParameters::static_level,
                                          &FrictionParameters::stiffness_N_per_m};

  static double steady_level(const FrictionParameters& parameters, double speed_m_per_s) {
    return falling_at_once(parameters, speed_m_per_s);
  }

  template <typename Vector>
  static ElasticStep<Vector> advance(const FrictionParameters& parameters,
                                     const FrictionTick<Vector>& tick,
                                     const FrictionMemory<Vector>& memory) {
    const double coulomb_N = parameters.coulomb * tick.normal_force_N;
    const double static_N = parameters.static_level * tick.normal_force_N;
    return advance_slider({.hold_N = memory.slipping ? coulomb_N : static_N, .slip_N = coulomb_N},
                          parameters.stiffness_N_per_m, tick, memory.elastic_force_N);
  }
};

}  // namespace tactus::rendering
