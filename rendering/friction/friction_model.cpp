#include "rendering/friction/friction_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rendering/friction/bristle.h"
#include "rendering/friction/dahl.h"
#include "rendering/friction/elasto_plastic.h"
#include "rendering/friction/lugre.h"
#include "rendering/friction/slider.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::rendering {
namespace {

// Beyond 6.1 widths a bell exp(-x^2) is below a double's rounding of 1.
constexpr double kBellIsOver = 37.0;

bool is_bristle(FrictionKind kind) {
  return kind == FrictionKind::dahl || kind == FrictionKind::lugre ||
         kind == FrictionKind::elasto_plastic;
}

bool is_damped(FrictionKind kind) {
  return kind != FrictionKind::cone && kind != FrictionKind::dahl;
}

double bell(double exponent) {
  return exponent < kBellIsOver ? exponential(-exponent) : 0.0;
}

template <typename Vector>
ElasticStep<Vector> advance_elastic(const FrictionParameters& parameters,
                                    const FrictionTick<Vector>& tick,
                                    const FrictionMemory<Vector>& memory) {
  switch (parameters.kind) {
    case FrictionKind::dahl:
      return advance_dahl(parameters, tick, memory.elastic_force_N);
    case FrictionKind::lugre:
      return advance_lugre(parameters, tick, memory.elastic_force_N);
    case FrictionKind::elasto_plastic:
      return advance_elasto_plastic(parameters, tick, memory.elastic_force_N);
    default:
      return advance_slider(parameters, tick, memory);
  }
}

}  // namespace

bool valid(const FrictionParameters& p) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  const std::array numbers{p.coulomb,
                           p.static_level,
                           p.viscous_s_per_m,
                           p.stribeck_velocity_m_per_s,
                           p.stribeck_exponent,
                           p.stiffness_N_per_m,
                           p.damping_s_per_m,
                           p.damping_fade_m_per_s,
                           p.stick_velocity_m_per_s,
                           p.elastic_fraction};
  return std::ranges::all_of(numbers, is_finite) &&
         std::ranges::all_of(numbers, [](double value) { return value >= 0.0; }) &&
         static_cast<std::size_t>(p.kind) < kFrictionKinds &&
         (!has_static_level(p.kind) || p.static_level >= p.coulomb) &&
         p.stribeck_velocity_m_per_s > 0.0 && p.stribeck_exponent > 0.0 &&
         p.stick_velocity_m_per_s > 0.0 && p.elastic_fraction > 0.0 && p.elastic_fraction < 1.0 &&
         (!is_bristle(p.kind) || p.stiffness_N_per_m > 0.0);
}

double steady_level(const FrictionParameters& p, double speed_m_per_s) {
  if (!has_static_level(p.kind)) {
    return p.coulomb;
  }
  if (p.kind == FrictionKind::cone || p.kind == FrictionKind::karnopp) {
    return speed_m_per_s > 0.0 ? p.coulomb : p.static_level;
  }
  const double ratio = speed_m_per_s / p.stribeck_velocity_m_per_s;
  if (!(ratio > 0.0)) {
    return p.static_level;
  }
  const double exponent = p.stribeck_exponent == 2.0
                              ? ratio * ratio
                              : exponential(p.stribeck_exponent * logarithm(ratio));
  return p.coulomb + (p.static_level - p.coulomb) * bell(exponent);
}

double damping_at(const FrictionParameters& p, double speed_m_per_s) {
  if (!is_damped(p.kind)) {
    return 0.0;
  }
  if (p.damping_fade_m_per_s <= 0.0) {
    return p.damping_s_per_m;
  }
  const double ratio = speed_m_per_s / p.damping_fade_m_per_s;
  return p.damping_s_per_m * bell(ratio * ratio);
}

template <typename Vector>
FrictionForce<Vector> update_friction(const FrictionParameters& parameters,
                                      FrictionMemory<Vector>& memory, const Vector& displacement_m,
                                      double normal_force_N, double step_s) {
  if (!(normal_force_N > 0.0)) {
    memory = {};
    return {};
  }
  const double path_m = length(displacement_m);
  const FrictionTick<Vector> tick{.displacement_m = displacement_m,
                                  .path_m = path_m,
                                  .speed_m_per_s = path_m / step_s,
                                  .normal_force_N = normal_force_N,
                                  .step_s = step_s};
  ElasticStep<Vector> elastic;
  if (parameters.coulomb > 0.0) {
    elastic = advance_elastic(parameters, tick, memory);
  }
  memory = {.elastic_force_N = elastic.end_N,
            .slipping = elastic.slipping,
            .left_band = elastic.left_band};
  FrictionForce<Vector> result{
      .force_N = elastic.end_N, .mean_force_N = elastic.mean_N, .slipping = elastic.slipping};
  const double per_step = normal_force_N / step_s;
  if (parameters.stiffness_N_per_m > 0.0) {
    result.bristle_m = elastic.end_N / parameters.stiffness_N_per_m;
    const double damping = damping_at(parameters, tick.speed_m_per_s) * per_step;
    const Vector damped = (damping / parameters.stiffness_N_per_m) * elastic.bent_N;
    result.force_N += damped;
    result.mean_force_N += damped;
  }
  if (parameters.kind != FrictionKind::cone) {
    const Vector viscous = (parameters.viscous_s_per_m * per_step) * displacement_m;
    result.force_N += viscous;
    result.mean_force_N += viscous;
  }
  return result;
}

template FrictionForce<double> update_friction(const FrictionParameters&, FrictionMemory<double>&,
                                               const double&, double, double);
template FrictionForce<Vec3> update_friction(const FrictionParameters&, FrictionMemory<Vec3>&,
                                             const Vec3&, double, double);

}  // namespace tactus::rendering
