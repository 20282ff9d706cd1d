#include "rendering/friction/friction_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rendering/friction/levels.h"

namespace tactus::rendering {
namespace {

template <typename Vector>
ElasticStep<Vector> advance_elastic(const FrictionParameters& parameters,
                                    const FrictionTick<Vector>& tick,
                                    const FrictionMemory<Vector>& memory) {
  return visit_number(FrictionModels{}, static_cast<std::size_t>(parameters.kind),
                      [&]<class Model>(std::type_identity<Model> /*model*/) {
                        return Model::advance(parameters, tick, memory);
                      });
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
         (!has_bristles(p.kind) || p.stiffness_N_per_m > 0.0);
}

double steady_level(const FrictionParameters& p, double speed_m_per_s) {
  return visit_number(FrictionModels{}, static_cast<std::size_t>(p.kind),
                      [&]<class Model>(std::type_identity<Model> /*model*/) {
                        return Model::steady_level(p, speed_m_per_s);
                      });
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
  if (is_viscous(parameters.kind)) {
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
