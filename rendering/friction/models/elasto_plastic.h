// The elasto-plastic model (Dupont, Hayward, Armstrong, Altpeter, "Single state elastoplastic
// friction models", IEEE Transactions on Automatic Control 47(5), 2002):
//   dz/dt = v (1 - alpha(z, v) sigma0 z sgn(v) / g(v)),
// the LuGre model but for alpha: 0 while the bristle unbends or |z| <= z_ba, 1 from
// z_ss = g / sigma0 on, and between them 1/2 + 1/2 sin(pi (|z| - (z_ss + z_ba)/2) / (z_ss - z_ba)).
// Below z_ba it is a spring and nothing more, so that it does not creep. In the plane the bristle
// unbends where z . v < 0.
//
// A tick is a straight path. Its first part, until |z| grows beyond z_ba, is elastic and exact.
// On a straight path |z| does not fall below z_ba again after that, and alpha is taken from the
// middle of short steps, on each of which the bristle yields exactly (bristle.h) with alpha held:
// second order, passive whatever alpha is. The first is an eighth of z_ss, each next one and a
// half times as long; after 32 z_ss the bristle lies along the path, at z_ss.
#pragma once

#include <algorithm>
#include <cmath>

#include "rendering/friction/bristle.h"
#include "rendering/friction/levels.h"

namespace tactus::rendering {

struct ElastoPlasticLevels {
  double break_away_N = 0.0;  // sigma0 z_ba
  double steady_N = 0.0;      // sigma0 z_ss
};

// alpha of a bristle that is not unbending.
inline double plastic_share(const ElastoPlasticLevels& levels, double elastic_force_N) {
  constexpr double kPi = 0x1.921fb54442d18p+1;
  if (elastic_force_N <= levels.break_away_N) {
    return 0.0;
  }
  if (elastic_force_N >= levels.steady_N) {
    return 1.0;
  }
  const double middle = 0.5 * (levels.steady_N + levels.break_away_N);
  const double width = levels.steady_N - levels.break_away_N;
  return 0.5 + 0.5 * sine_cosine(kPi * (elastic_force_N - middle) / width).sine;
}

// Returns how far a bristle moves along `direction` (unit) as a spring, m: until it no longer
// unbends and is longer than break-away.
template <typename Vector>
double elastic_path_m(const ElastoPlasticLevels& levels, double stiffness_N_per_m, const Vector& f,
                      const Vector& direction) {
  const double along = dot(f, direction);
  const double across_squared = std::max(0.0, dot(f, f) - along * along);
  const double rim_squared = levels.break_away_N * levels.break_away_N - across_squared;
  return std::max(0.0, (rim_squared > 0.0 ? std::sqrt(rim_squared) : 0.0) - along) /
         stiffness_N_per_m;
}

template <typename Vector>
void add_part(ElasticStep<Vector>& sum, const ElasticStep<Vector>& part, double share) {
  sum.end_N = part.end_N;
  sum.mean_N += share * part.mean_N;
  sum.bent_N += part.bent_N;
}

// Computes one short step of the plastic part, with the alpha of its middle.
template <typename Vector>
ElasticStep<Vector> plastic_step(const ElastoPlasticLevels& levels, double stiffness_N_per_m,
                                 const Vector& f, const Vector& direction, double path_m) {
  // At alpha = 0 the level where dz/dt vanishes is infinite, and the bristle is a spring.
  constexpr double kLeastShare = 1e-12;
  const auto yield = [&](double share, double part_m) {
    return yield_toward(levels.steady_N / std::max(share, kLeastShare), stiffness_N_per_m, f,
                        Vector{part_m * direction}, part_m);
  };
  const Vector middle = yield(plastic_share(levels, length(f)), 0.5 * path_m).end_N;
  ElasticStep<Vector> step = yield(plastic_share(levels, length(middle)), path_m);
  step.end_N = cut_to(step.end_N, std::max(length(f), levels.steady_N));
  return step;
}

struct ElastoPlasticModel {
  static constexpr std::string_view kName = "elasto_plastic";
  static constexpr std::string_view kTitle = "elasto-plastic";
  static constexpr bool kHasBristles = true;
  static constexpr std::array kParameters{
      &FrictionParameters::coulomb,           &FrictionParameters::static_level,
      &FrictionParameters::viscous_s_per_m,   &FrictionParameters::stribeck_velocity_m_per_s,
      &FrictionParameters::stribeck_exponent, &FrictionParameters::stiffness_N_per_m,
      &FrictionParameters::damping_s_per_m,   &FrictionParameters::damping_fade_m_per_s,
      &FrictionParameters::elastic_fraction};

  static double steady_level(const FrictionParameters& parameters, double speed_m_per_s) {
    return falling_with_speed(parameters, speed_m_per_s);
  }

  template <typename Vector>
  static ElasticStep<Vector> advance(const FrictionParameters& parameters,
                                     const FrictionTick<Vector>& tick,
                                     const FrictionMemory<Vector>& memory) {
    constexpr double kSettled = 32.0;
    constexpr double kFirstStep = 0.125;
    constexpr double kGrowth = 1.5;
    const double stiffness = parameters.stiffness_N_per_m;
    const double normal = tick.normal_force_N;
    const ElastoPlasticLevels levels{
        .break_away_N = parameters.elastic_fraction * parameters.coulomb * normal,
        .steady_N = steady_level(parameters, tick.speed_m_per_s) * normal};
    const Vector start = cut_to(memory.elastic_force_N, parameters.static_level * normal);
    ElasticStep<Vector> sum{.end_N = start, .mean_N = start};
    if (tick.path_m <= 0.0) {
      return sum;
    }
    const Vector direction = tick.displacement_m / tick.path_m;
    const double elastic_m =
        std::min(tick.path_m, elastic_path_m(levels, stiffness, start, direction));
    const Vector stretch = (stiffness * elastic_m) * direction;
    const double share = elastic_m / tick.path_m;
    sum.mean_N = share * (start + 0.5 * stretch);
    sum.end_N = start + stretch;
    sum.bent_N = stretch;
    double left_m = tick.path_m - elastic_m;
    const double unit_m = levels.steady_N / stiffness;
    double step_m = kFirstStep * unit_m;
    if (left_m > kSettled * unit_m) {
      const Vector slid = levels.steady_N * direction;
      sum.bent_N += slid - sum.end_N;
      sum.mean_N += (left_m / tick.path_m) * slid;
      sum.end_N = slid;
      left_m = 0.0;
    }
    while (left_m > 0.0) {
      const double part_m = std::min(step_m, left_m);
      add_part(sum, plastic_step(levels, stiffness, sum.end_N, direction, part_m),
               part_m / tick.path_m);
      left_m -= part_m;
      step_m *= kGrowth;
    }
    sum.slipping = 2.0 * length(sum.bent_N) < stiffness * tick.path_m;
    return sum;
  }
};

}  // namespace tactus::rendering
