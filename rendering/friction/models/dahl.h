// Dahl's model (P. R. Dahl, "A solid friction model", Aerospace Corporation TOR-158(3107-18),
// 1968):
//   dF/dx = sigma0 (1 - F sgn(v) / Fc).
// The force depends on the path alone, not on the speed. Between two reversals the
// solution is F = s Fc + (F0 - s Fc) exp(-sigma0 |x - x0| / Fc), s = sgn(v); a steady loop of the
// amplitude A turns at Fc tanh(sigma0 A / Fc) and takes 4 Fc (A - (Fc / sigma0) tanh(sigma0 A /
// Fc)). It creeps: under a force that swings between F1 and F2 on one side, by (Fc / sigma0)
// ln((Fc^2 - F1^2) / (Fc^2 - F2^2)) a cycle.
#pragma once

#include "rendering/friction/bristle.h"

namespace tactus::rendering {

struct DahlModel {
  static constexpr std::string_view kName = "dahl";
  static constexpr std::string_view kTitle = "Dahl";
  static constexpr bool kHasBristles = true;
  static constexpr std::array kParameters{&FrictionParameters::coulomb,
                                          &FrictionParameters::viscous_s_per_m,
                                          &FrictionParameters::stiffness_N_per_m};

  static double steady_level(const FrictionParameters& parameters, double /*speed_m_per_s*/) {
    return parameters.coulomb;
  }

  template <typename Vector>
  static ElasticStep<Vector> advance(const FrictionParameters& parameters,
                                     const FrictionTick<Vector>& tick,
                                     const FrictionMemory<Vector>& memory) {
    const double level_N = parameters.coulomb * tick.normal_force_N;
    return yield_toward(level_N, parameters.stiffness_N_per_m,
                        cut_to(memory.elastic_force_N, level_N), tick.displacement_m, tick.path_m);
  }
};

}  // namespace tactus::rendering
