// The LuGre model (Canudas de Wit, Olsson, Astrom, Lischinsky, "A new model for control of systems
// with friction", IEEE Transactions on Automatic Control 40(3), 1995), with a normal force N:
//   dz/dt = v - sigma0 |v| z / (N g(v)),   g(v) = Fc + (Fs - Fc) exp(-|v/vs|^alpha),
//   F = sigma0 z + N sigma1(v) dz/dt + N sigma2 v.
// A tick holds v and N, so that g is one number, and the bristle yields exponentially (bristle.h):
// exact, and stable where Euler's rule is not above 2 N g / (sigma0 T), 0.02 m/s at 1 kHz for the
// paper's values. dz/dt enters by its mean over the tick, which makes the tick's work that of the
// continuous model and hands its passivity on (passivity.h).
//
// |z| never exceeds N Fs / sigma0: each tick ends between where it began and N g / sigma0, and when
// N falls, z is cut to it first.
#pragma once

#include "rendering/friction/bristle.h"
#include "rendering/friction/levels.h"

namespace tactus::rendering {

struct LugreModel {
  static constexpr std::string_view kName = "lugre";
  static constexpr std::string_view kTitle = "LuGre";
  static constexpr bool kHasBristles = true;
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
    const Vector start =
        cut_to(memory.elastic_force_N, parameters.static_level * tick.normal_force_N);
    return yield_toward(level_N, parameters.stiffness_N_per_m, start, tick.displacement_m,
                        tick.path_m);
  }
};

}  // namespace tactus::rendering
