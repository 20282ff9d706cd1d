// The common part of the models without a law for presliding, the sliders: each sticks by a spring
// of stiffness sigma0 up to one level, and slips at another.
//
// Coulomb's force has no value at rest but a bound, which a function of the motion cannot give. The
// spring makes it one: f grows by sigma0 dx, and where it leaves the circle of the level it is
// drawn back to the rim, straight to the centre. That is the cone's rule with f = sigma0 times the
// lag (Melder and Harwin, 2004; cone.h), and the backward Euler rule of perfect plasticity. sigma0
// of 0 stands for a rigid surface: then any motion at all slips.
//
// Work: a tick that stays within the circle is a spring's. Otherwise its first part, up to the rim,
// is; the rest slides with the force f1 of its end, and from f to f1, with the trial force t
// outside, f1 . (t - f) - (f1^2 - f^2) / 2 = f1 . (t - f1) + (f1 - f)^2 / 2 >= 0: heat.
#pragma once

#include <algorithm>
#include <cmath>

#include "rendering/friction/bristle.h"

namespace tactus::rendering {

// The force up to which a slider sticks, and the force with which it slips, N.
struct SliderLevels {
  double hold_N = 0.0;
  double slip_N = 0.0;
};

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

// `f` is the elastic force at the tick's start; a stiffness of 0 means rigid.
template <typename Vector>
ElasticStep<Vector> advance_slider(const SliderLevels& levels, double stiffness_N_per_m,
                                   const FrictionTick<Vector>& tick, const Vector& f) {
  // A slipping slider lies on the rim itself; rounding must not make it slip again.
  constexpr double kRim = 1.0 + 1e-9;
  if (stiffness_N_per_m <= 0.0) {
    return advance_rigid(levels, tick, f);
  }
  const Vector stretch = stiffness_N_per_m * tick.displacement_m;
  const Vector trial = f + stretch;
  const double size = length(trial);
  ElasticStep<Vector> result;
  if (size <= levels.hold_N * kRim) {
    result.end_N = trial;
    result.mean_N = f + 0.5 * stretch;
    result.bent_N = stretch;
  } else {
    const double share = share_within(levels.hold_N, f, stretch);
    result.end_N = (levels.slip_N / size) * trial;
    result.mean_N = share * (f + 0.5 * share * stretch) + (1.0 - share) * result.end_N;
    result.slipping = true;
  }
  return result;
}

}  // namespace tactus::rendering
