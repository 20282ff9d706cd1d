#include "host_tools/friction/fit_space.h"

#include <algorithm>
#include <cmath>

namespace tactus::host {

using rendering::FrictionParameters;

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
  constexpr double kFarthest = 25.0;  // of a logarithm
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
  rendering::FrictionMemory<double> memory{.elastic_force_N = point[Quantity::start_force]};
  out.resize(static_cast<Eigen::Index>(record.rows()) - 1);
  const bool is_rigid = !(friction.stiffness_N_per_m > 0.0);
  const double hold = rendering::steady_level(friction, 0.0);
  for (std::size_t k = 1; k < record.rows(); ++k) {
    const double normal_N = record.normal_force_N[k];
    const double force_N = rendering::update_friction(friction, memory, record.displacement_m[k],
                                                      normal_N, record.step_s[k])
                               .force_N;
    const double most_N = hold * std::max(normal_N, 0.0);
    out(static_cast<Eigen::Index>(k) - 1) = is_rigid && record.is_at_reversal(k)
                                                ? std::clamp(record.force_N[k], -most_N, most_N)
                                                : force_N;
  }
}

double sum_of_squares(const FitPoint& point, const FrictionRecord& record) {
  Eigen::VectorXd forces;
  model_forces(point, record, forces);
  double sum = 0.0;
  for (std::size_t k = 1; k < record.rows(); ++k) {
    const double difference = forces(static_cast<Eigen::Index>(k) - 1) - record.force_N[k];
    sum += difference * difference;
  }
  return sum;
}

}  // namespace tactus::host
