// The parameters of the published experiments (Canudas de Wit et al. 1995, table I), without a
// normal force: N, N/m, N s/m; and the tick of a controller at 1 kHz.
#pragma once

#include <array>

#include "rendering/friction/friction_model.h"

namespace tactus::testing {

inline constexpr double kTick_s = 1e-3;

// The rates of a controller at which the experiments are run.
inline constexpr std::array kRates_Hz{1000.0, 4000.0};

inline rendering::FrictionParameters published(rendering::FrictionKind kind) {
  return {.kind = kind,
          .coulomb = 1.0,
          .static_level = 1.5,
          .viscous_s_per_m = 0.4,
          .stribeck_velocity_m_per_s = 1e-3,
          .stiffness_N_per_m = 1e5,
          .damping_s_per_m = 316.22776601683796,
          .elastic_fraction = 0.7};
}

}  // namespace tactus::testing
