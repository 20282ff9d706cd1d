// Karnopp's model ("Computer simulation of stick-slip friction in mechanical dynamic systems", J.
// Dynamic Systems, Measurement and Control 107(1), 1985): a slip ends when the velocity falls below
// a band, and then it takes Fs to break away again, whatever the rate. A slip that has not yet left
// the band goes on until the motion turns back.
#pragma once

#include "rendering/friction/levels.h"
#include "rendering/friction/slider.h"

namespace tactus::rendering {

struct KarnoppModel {
  static constexpr std::string_view kName = "karnopp";
  static constexpr std::string_view kTitle = "Karnopp";
  static constexpr bool kHasBristles = false;
  static constexpr std::array kParameters{&FrictionParameters::coulomb,
                                          &FrictionParameters::static_level,
                                          &FrictionParameters::viscous_s_per_m,
                                          &FrictionParameters::stiffness_N_per_m,
                                          &FrictionParameters::damping_s_per_m,
                                          &FrictionParameters::damping_fade_m_per_s,
                                          &FrictionParameters::stick_velocity_m_per_s};

  static double steady_level(const FrictionParameters& parameters, double speed_m_per_s) {
    return falling_at_once(parameters, speed_m_per_s);
  }

  template <typename Vector>
  static ElasticStep<Vector> advance(const FrictionParameters& parameters,
                                     const FrictionTick<Vector>& tick,
                                     const FrictionMemory<Vector>& memory) {
    const double coulomb_N = parameters.coulomb * tick.normal_force_N;
    const double static_N = parameters.static_level * tick.normal_force_N;
    const bool is_slow = tick.speed_m_per_s < parameters.stick_velocity_m_per_s;
    const bool slip_ends = is_slow && memory.left_band;
    const bool goes_on = memory.slipping && !slip_ends;
    ElasticStep<Vector> step =
        advance_slider({.hold_N = goes_on ? coulomb_N : static_N, .slip_N = coulomb_N},
                       parameters.stiffness_N_per_m, tick, memory.elastic_force_N);
    // A rigid slider slips whenever it moves, and has no band to leave.
    if (parameters.stiffness_N_per_m > 0.0) {
      step.slipping = step.slipping || (memory.slipping && !is_slow);
      step.left_band = step.slipping && (memory.left_band || !is_slow);
    }
    return step;
  }
};

}  // namespace tactus::rendering
