#include "host_tools/friction/sliding_mass.h"

#include <cmath>

namespace tactus::host {

using rendering::FrictionKind;

void SlidingMass::place(double x_m, double v_m_per_s) {
  state_ = {.x_m = x_m, .v_m_per_s = v_m_per_s};
  bristle_ = {};
}

double SlidingMass::energy_J() const {
  return 0.5 * parameters_.mass_kg * state_.v_m_per_s * state_.v_m_per_s +
         rendering::stored_J(parameters_.friction, bristle_);
}

// Returns by how much the forces exceed what stops the mass at d, N; its root is the displacement.
// `supply_N` is 2 m v0 / T + u + k (y - x0).
double SlidingMass::excess_N(double displacement_m, double supply_N, double step_s) const {
  rendering::FrictionMemory<double> trial = bristle_;
  const double friction_N = rendering::update_friction(parameters_.friction, trial, displacement_m,
                                                       parameters_.normal_force_N, step_s)
                                .mean_force_N;
  const double inertia = 2.0 * parameters_.mass_kg / (step_s * step_s);
  return (inertia + 0.5 * parameters_.spring_N_per_m) * displacement_m + friction_N - supply_N;
}

// The bracket grows from v0 T to the side on which a root must lie, so that it contains the nearest
// root, or one of several in its last stretch. Then it is halved until no double lies between its
// ends.
double SlidingMass::solve(double supply_N, double step_s) const {
  constexpr int kMostDoublings = 200;
  constexpr int kMostHalvings = 200;
  const double start = state_.v_m_per_s * step_s;
  const double excess = excess_N(start, supply_N, step_s);
  const bool falls_short = excess < 0.0;
  const auto is_near = [&](double d) {
    return (excess_N(d, supply_N, step_s) < 0.0) == falls_short;
  };
  const double inertia = 2.0 * parameters_.mass_kg / (step_s * step_s);
  double reach = (falls_short ? 1e-3 : -1e-3) * std::fabs(excess) / inertia;
  double near = start;
  double far = start + reach;
  for (int i = 0; i < kMostDoublings && near != far && is_near(far); ++i) {
    near = far;
    reach *= 2.0;
    far = start + reach;
  }
  for (int i = 0; i < kMostHalvings; ++i) {
    const double middle = 0.5 * (near + far);
    if (middle == near || middle == far) {
      break;
    }
    (is_near(middle) ? near : far) = middle;
  }
  return far;
}

// Rigid friction at rest is whatever force is needed, up to a level. Coulomb's model, and a cone
// that was slipping, let go at Fc; the others at Fs.
bool SlidingMass::hold(double supply_N, double step_s) {
  const rendering::FrictionParameters& friction = parameters_.friction;
  if (friction.stiffness_N_per_m > 0.0) {
    return false;
  }
  const bool slips_on = friction.kind == FrictionKind::cone && bristle_.slipping;
  const double level = slips_on ? friction.coulomb : rendering::holding_level(friction);
  const double needed_N = supply_N - parameters_.mass_kg * state_.v_m_per_s / step_s;
  if (std::fabs(needed_N) > level * parameters_.normal_force_N) {
    return false;
  }
  bristle_ = {.elastic_force_N = needed_N, .slipping = false};
  state_.friction = {.force_N = needed_N, .mean_force_N = needed_N};
  state_.v_m_per_s = 0.0;
  return true;
}

const SlidingMassState& SlidingMass::step(const Drive& drive, double step_s) {
  const double supply_N = 2.0 * parameters_.mass_kg * state_.v_m_per_s / step_s + drive.push_N +
                          parameters_.spring_N_per_m * (drive.spring_end_m - state_.x_m);
  state_.time_s += step_s;
  if (hold(supply_N, step_s)) {
    return state_;
  }
  const double displacement_m = solve(supply_N, step_s);
  state_.friction = rendering::update_friction(parameters_.friction, bristle_, displacement_m,
                                               parameters_.normal_force_N, step_s);
  state_.x_m += displacement_m;
  state_.v_m_per_s = 2.0 * displacement_m / step_s - state_.v_m_per_s;
  return state_;
}

}  // namespace tactus::host
