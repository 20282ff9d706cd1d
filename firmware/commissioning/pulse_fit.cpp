#include "firmware/commissioning/pulse_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "rendering/geometry/vector.h"

namespace tactus::firmware {
namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

// A joint that moves less than this share of the record's largest step counts as standing still.
constexpr double kStandingShare = 0.02;
// The number of positions over which a step is smoothed, so that single encoder counts do not
// determine the sign of friction.
constexpr std::size_t kSmoothing = 3;

// Returns the sign of the motion around sample k: -1, 0 or 1. `standing` is in rad or m.
double direction(std::span<const double> position, std::size_t k, double standing) {
  const std::size_t before = k >= kSmoothing ? k - kSmoothing : 0;
  const std::size_t after = std::min(k + kSmoothing, position.size() - 1);
  const double step = position[after] - position[before];
  return std::abs(step) <= standing ? 0.0 : std::copysign(1.0, step);
}

// Returns the largest smoothed step of the record, rad or m.
double fastest_step(std::span<const double> position) {
  double fastest = 0.0;
  for (std::size_t k = 2 * kSmoothing; k < position.size(); ++k) {
    fastest = std::max(fastest, std::abs(position[k] - position[k - (2 * kSmoothing)]));
  }
  return fastest;
}

// The solution for one delay.
struct Solved {
  // Inertia, viscous friction, sliding friction and load.
  Vec4 parameters = Vec4::Zero();
  // The squared error that is left, and the squared size of the right-hand side before the fit.
  double residual = std::numeric_limits<double>::infinity();
  double size = 0.0;
};

// Solves the integrated equation for one delay by normal equations.
Solved solve(const PulseRecord& record, double step_s, std::size_t delay, double standing) {
  const std::span position(record.position.data(), record.count);
  Mat4 normal = Mat4::Zero();
  Vec4 right = Vec4::Zero();
  double size = 0.0;
  double way = 0.0;         // S (q - q0)
  double friction_1 = 0.0;  // S sign
  double friction_2 = 0.0;
  double effort_1 = 0.0;
  double effort_2 = 0.0;
  for (std::size_t k = 0; k < record.count; ++k) {
    const double time_s = step_s * static_cast<double>(k);
    const Vec4 row(position[k] - position[0], way, friction_2, -0.5 * time_s * time_s);
    normal += row * row.transpose();
    right += row * effort_2;
    size += effort_2 * effort_2;
    // An effort is held until the next sample, so its integral is exact; the others use the
    // midpoint rule.
    const double effort = k >= delay ? record.effort[k - delay] : 0.0;
    effort_2 += step_s * (effort_1 + 0.5 * step_s * effort);
    effort_1 += step_s * effort;
    const double sign = direction(position, k, standing);
    friction_2 += step_s * (friction_1 + 0.5 * step_s * sign);
    friction_1 += step_s * sign;
    const double next = k + 1 < record.count ? position[k + 1] : position[k];
    way += 0.5 * step_s * (position[k] + next - 2.0 * position[0]);
  }
  // A little regularisation, far below the data, because a record may not separate all four
  // numbers.
  const Vec4 scale = normal.diagonal().cwiseMax(std::numeric_limits<double>::min());
  constexpr double kTrace = 1e-9;
  normal.diagonal() += kTrace * scale;
  Solved solved;
  solved.parameters = normal.ldlt().solve(right);
  solved.size = size;
  solved.residual = size - right.dot(solved.parameters);
  return solved;
}

// Returns the ratio of reported to commanded effort by least squares, at the shift with the largest
// correlation, because a report arrives some ticks after its command.
double reported_share(const PulseRecord& record) {
  double best = 0.0;
  double most = 0.0;
  for (std::size_t delay = 0; delay <= kMaxPulseDelay && delay < record.count; ++delay) {
    double both = 0.0;
    double own = 0.0;
    for (std::size_t k = delay; k < record.count; ++k) {
      both += record.effort[k - delay] * record.reported[k];
      own += record.effort[k - delay] * record.effort[k - delay];
    }
    if (own > 0.0 && std::abs(both) > most) {
      most = std::abs(both);
      best = both / own;
    }
  }
  return best;
}

}  // namespace

PulseFit fit_pulse(const PulseRecord& record, double step_s) {
  PulseFit fit;
  const std::span position(record.position.data(), record.count);
  for (std::size_t k = 1; k < position.size(); ++k) {
    fit.travel = std::max(fit.travel, std::abs(position[k] - position[0]));
    const double step = std::abs(position[k] - position[k - 1]);
    if (step > 0.0 && (fit.quantum == 0.0 || step < fit.quantum)) {
      fit.quantum = step;
    }
  }
  fit.reported_share = record.has_reported ? reported_share(record) : 0.0;
  if (fit.travel == 0.0) {
    return fit;
  }
  const double standing = kStandingShare * fastest_step(position);
  Solved best;
  for (std::size_t delay = 0; delay <= kMaxPulseDelay; ++delay) {
    const Solved solved = solve(record, step_s, delay, standing);
    if (solved.residual < best.residual) {
      best = solved;
      fit.delay_ticks = delay;
    }
  }
  fit.inertia = best.parameters[0];
  fit.viscous = best.parameters[1];
  fit.friction = best.parameters[2];
  fit.load = best.parameters[3];
  fit.explained = best.size > 0.0 ? 1.0 - (best.residual / best.size) : 0.0;
  return fit;
}

}  // namespace tactus::firmware
