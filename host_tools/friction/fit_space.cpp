#include "host_tools/friction/fit_space.h"

#include <algorithm>
#include <cmath>

namespace tactus::host {

using rendering::FrictionParameters;

namespace {

// Returns the force of the first row, which has no tick before it: the bristle's and the viscous
// part, N.
double start_force_N(const FitPoint& point, const FrictionParameters& friction,
                     const FrictionRecord& record) {
  const double v = record.displacement_m[1] / record.step_s[1];
  return point[Quantity::start_force] + friction.viscous_s_per_m * record.normal_force_N[0] * v;
}

// Replaces a rigid model's force at reversals by the measured one, as far as static friction
// permits.
void bound_at_reversals(const FrictionParameters& friction, const FrictionRecord& record,
                        Eigen::VectorXd& forces) {
  const double hold = rendering::steady_level(friction, 0.0);
  for (std::size_t k = 1; k < record.rows(); ++k) {
    if (record.is_at_reversal(k)) {
      const double most_N = hold * std::max(record.normal_force_N[k], 0.0);
      forces(static_cast<Eigen::Index>(k)) = std::clamp(record.force_N[k], -most_N, most_N);
    }
  }
}

}  // namespace

std::string_view symbol_of(Quantity quantity) {
  constexpr std::array<std::string_view, kQuantities> kSymbols{"Fc",    "Fs",     "sigma2", "vs",
                                                               "alpha", "sigma0", "sigma1", ""};
  return kSymbols.at(static_cast<std::size_t>(quantity));
}

std::vector<Quantity> FitPoint::free_quantities() const {
  std::vector<Quantity> result;
  for (std::size_t i = 0; i < kQuantities; ++i) {
    if (free[i]) {
      result.push_back(static_cast<Quantity>(i));
    }
  }
  return result;
}

FitPoint FitPoint::moved(const Eigen::VectorXd& by) const {
  // A step of a logarithm beyond this would overflow the model.
  constexpr double kFarthest = 25.0;
  FitPoint there = *this;
  Eigen::Index i = 0;
  for (const Quantity q : free_quantities()) {
    const double step = by(i++);
    there.set(q, q == Quantity::start_force
                     ? (*this)[q] + step * force_scale_N
                     : (*this)[q] * std::exp(std::clamp(step, -kFarthest, kFarthest)));
  }
  return there;
}

FrictionParameters FitPoint::friction() const {
  return {.kind = kind,
          .coulomb = (*this)[Quantity::coulomb],
          .static_level = (*this)[Quantity::coulomb] + (*this)[Quantity::excess],
          .viscous_s_per_m = (*this)[Quantity::viscous],
          .stribeck_velocity_m_per_s = (*this)[Quantity::stribeck_velocity],
          .stribeck_exponent = (*this)[Quantity::exponent],
          .stiffness_N_per_m = (*this)[Quantity::stiffness],
          .damping_s_per_m = (*this)[Quantity::damping]};
}

void model_forces(const FitPoint& point, const FrictionRecord& record, Eigen::VectorXd& out) {
  const FrictionParameters friction = point.friction();
  const bool is_rigid = !(friction.stiffness_N_per_m > 0.0);
  const auto rows = static_cast<Eigen::Index>(record.rows());
  rendering::FrictionMemory<double> memory{.elastic_force_N = point[Quantity::start_force]};
  out.resize(rows);
  out(0) = point.is_free(Quantity::start_force) ? start_force_N(point, friction, record)
                                                : record.force_N[0];
  for (Eigen::Index i = 1; i < rows; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double force_N = rendering::update_friction(friction, memory, record.displacement_m[k],
                                                      record.normal_force_N[k], record.step_s[k])
                               .force_N;
    // Half of what depends on the velocity belongs to the row before.
    const double of_place_N = is_rigid ? 0.0 : memory.elastic_force_N;
    const double half_N = point.row_time == RowTime::instant ? 0.5 * (force_N - of_place_N) : 0.0;
    out(i) = i + 1 < rows ? force_N - half_N : force_N;
    if (i > 1) {
      out(i - 1) += half_N;
    }
  }
  if (is_rigid) {
    bound_at_reversals(friction, record, out);
  }
}

double sum_of_squares(const FitPoint& point, const FrictionRecord& record) {
  Eigen::VectorXd forces;
  model_forces(point, record, forces);
  const Eigen::Map<const Eigen::VectorXd> measured(record.force_N.data(), forces.size());
  return (forces - measured).squaredNorm();
}

}  // namespace tactus::host
