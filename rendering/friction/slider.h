// The models without a law for presliding: the cone, Coulomb and viscous, Stribeck, Karnopp. Each
// sticks by a spring of stiffness sigma0, and slips at a level.
//
// Coulomb's force has no value at rest but a bound, which a function of the motion cannot give. The
// spring makes it one: f grows by sigma0 dx, and where it leaves the circle of the level it is
// drawn back to the rim, straight to the centre. That is the cone's rule with f = sigma0 times the
// lag (Melder and Harwin, 2004; cone.h), and the backward Euler rule of perfect plasticity. sigma0
// of 0 stands for a rigid surface: then any motion at all slips.
//
// Karnopp ("Computer simulation of stick-slip friction in mechanical dynamic systems", J. Dynamic
// Systems, Measurement and Control 107(1), 1985): a slip ends when the velocity falls below a band,
// and then it takes Fs to break away again, whatever the rate. A slip that has not yet left the
// band goes on until the motion turns back.
//
// Work: a tick that stays within the circle is a spring's. Otherwise its first part, up to the rim,
// is; the rest slides with the force f1 of its end, and from f to f1, with the trial force t
// outside, f1 . (t - f) - (f1^2 - f^2) / 2 = f1 . (t - f1) + (f1 - f)^2 / 2 >= 0: heat.
#pragma once

#include <algorithm>
#include <cmath>

#include "rendering/friction/bristle.h"
#include "rendering/friction/friction_model.h"

namespace tactus::rendering {

// The force up to which a slider sticks, and the force with which it slips, N.
struct SliderLevels {
  double hold_N = 0.0;
  double slip_N = 0.0;
};

template <typename Vector>
SliderLevels slider_levels(const FrictionParameters& parameters, const FrictionTick<Vector>& tick,
                           bool holds_at_coulomb) {
  const double coulomb_N = parameters.coulomb * tick.normal_force_N;
  const double static_N = parameters.static_level * tick.normal_force_N;
  switch (parameters.kind) {
    case FrictionKind::cone:
    case FrictionKind::karnopp:
      return {.hold_N = holds_at_coulomb ? coulomb_N : static_N, .slip_N = coulomb_N};
    case FrictionKind::stribeck: {
      const double level_N = steady_level(parameters, tick.speed_m_per_s) * tick.normal_force_N;
      return {.hold_N = level_N, .slip_N = level_N};
    }
    default:
      return {.hold_N = coulomb_N, .slip_N = coulomb_N};
  }
}

// Returns the share of a motion, from 0 to 1, that lies within the circle of radius `hold_N`; the
// motion leaves the circle.
template <typename Vector>
double share_within(double hold_N, const Vector& f, const Vector& stretch) {
  const double room = hold_N * hold_N - dot(f, f);
  const double squared = dot(stretch, stretch);
  if (room < 0.0 || squared <= 0.0) {
    return 0.0;
  }
  const double along = dot(f, stretch);
  const double root = (-along + std::sqrt(along * along + room * squared)) / squared;
  return std::clamp(root, 0.0, 1.0);
}

template <typename Vector>
ElasticStep<Vector> advance_rigid(const SliderLevels& levels, const FrictionTick<Vector>& tick,
                                  const Vector& f) {
  if (tick.path_m <= 0.0) {
    const Vector held = cut_to(f, levels.hold_N);
    return {.end_N = held, .mean_N = held};
  }
  const Vector slid = (levels.slip_N / tick.path_m) * tick.displacement_m;
  return {.end_N = slid, .mean_N = slid, .slipping = true};
}

template <typename Vector>
ElasticStep<Vector> advance_slider(const FrictionParameters& parameters,
                                   const FrictionTick<Vector>& tick,
                                   const FrictionMemory<Vector>& memory) {
  // A slipping slider lies on the rim itself; rounding must not make it slip again.
  constexpr double kRim = 1.0 + 1e-9;
  const bool is_karnopp = parameters.kind == FrictionKind::karnopp;
  const bool is_slow = is_karnopp && tick.speed_m_per_s < parameters.stick_velocity_m_per_s;
  const bool slip_ends = is_slow && memory.left_band;
  const SliderLevels levels = slider_levels(parameters, tick, memory.slipping && !slip_ends);
  const Vector& f = memory.elastic_force_N;
  if (parameters.stiffness_N_per_m <= 0.0) {
    return advance_rigid(levels, tick, f);
  }
  const Vector stretch = parameters.stiffness_N_per_m * tick.displacement_m;
  const Vector trial = f + stretch;
  const double size = length(trial);
  ElasticStep<Vector> result;
  if (size <= levels.hold_N * kRim) {
    result.end_N = trial;
    result.mean_N = f + 0.5 * stretch;
    result.bent_N = stretch;
    result.slipping = is_karnopp && memory.slipping && !is_slow;
  } else {
    const double share = share_within(levels.hold_N, f, stretch);
    result.end_N = (levels.slip_N / size) * trial;
    result.mean_N = share * (f + 0.5 * share * stretch) + (1.0 - share) * result.end_N;
    result.slipping = true;
  }
  result.left_band = result.slipping && is_karnopp && (memory.left_band || !is_slow);
  return result;
}

}  // namespace tactus::rendering
