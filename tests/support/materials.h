// Materials and lengths that many tests share.
#pragma once

#include "rendering/material/material.h"

namespace tactus::testing {

inline constexpr double kMicron = 1e-6;  // metres
inline constexpr rendering::Material kSlippery{.stiffness_N_per_m = 1000.0};
inline constexpr rendering::Material kRough{.stiffness_N_per_m = 1000.0,
                                            .friction = rendering::cone_friction(0.6, 0.4)};

}  // namespace tactus::testing
