#include "rendering/friction/sampled_device.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "rendering/friction/bristle.h"

namespace tactus::rendering {
namespace {

constexpr std::size_t kMostCoefficients = kMaxDelayTicks + 4;

// Coefficients from the constant one upward.
struct Polynomial {
  std::array<double, kMostCoefficients> c{};
  std::size_t degree = 0;
};

bool is_covered(const SampledDevice& device) {
  return device.delay_ticks >= 0 && device.delay_ticks <= kMaxDelayTicks;
}

// (z - 1)(z - p) z^(n+1) + (b1 z + b2)(K z + (z - 1) B / T), where (b1 z + b2) / ((z - 1)(z - p))
// is the device with a held force: p = exp(-b T / m), and with the means of that decay, b1 = rest
// T^2 / m, b2 = (mean - rest) T^2 / m.
Polynomial characteristic(const SampledDevice& device, const RenderedSpring& spring) {
  const double step = device.step_s;
  const Decay d = decay(device.damping_Ns_per_m * step / device.mass_kg);
  const double per_force = step * step / device.mass_kg;
  const double b1 = d.rest * per_force;
  const double b2 = (d.mean - d.rest) * per_force;
  const double back = spring.damping_Ns_per_m / step;
  const double front = spring.stiffness_N_per_m + back;
  const auto n = static_cast<std::size_t>(device.delay_ticks);
  Polynomial p{.degree = n + 3};
  p.c[n + 1] += d.left;
  p.c[n + 2] -= 1.0 + d.left;
  p.c[n + 3] += 1.0;
  p.c[0] -= b2 * back;
  p.c[1] += b2 * front - b1 * back;
  p.c[2] += b1 * front;
  return p;
}

// Schur and Cohn: all roots lie within the circle of radius r if in p(r z), and in each polynomial
// that the recursion makes of it, the first coefficient is smaller than the last.
bool roots_lie_within(Polynomial p, double radius) {
  double power = 1.0;
  for (std::size_t k = 0; k <= p.degree; ++k) {
    p.c[k] *= power;
    power *= radius;
  }
  for (std::size_t degree = p.degree; degree > 0; --degree) {
    const double ratio = p.c[0] / p.c[degree];
    if (!(std::fabs(ratio) < 1.0)) {
      return false;
    }
    std::array<double, kMostCoefficients> next{};
    for (std::size_t k = 0; k < degree; ++k) {
      next[k] = p.c[k + 1] - ratio * p.c[degree - k - 1];
    }
    p.c = next;
  }
  return true;
}

bool is_stable(const SampledDevice& device, const RenderedSpring& spring) {
  return roots_lie_within(characteristic(device, spring), 1.0);
}

// `holds` is true at `good` and false at `bad`.
template <typename Predicate>
double last_that_holds(double good, double bad, const Predicate& holds) {
  constexpr int kToRounding = 60;
  for (int i = 0; i < kToRounding; ++i) {
    const double middle = 0.5 * (good + bad);
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

// Returns the largest value below `hopeless` at which `holds` is true. It searches downward in
// steps of two percent, then by bisection. `holds` must be false at `hopeless`.
template <typename Predicate>
double largest_that_holds(double hopeless, const Predicate& holds) {
  constexpr double kStep = 1.02;
  constexpr int kSteps = 1200;  // ten decades
  double above = hopeless;
  for (int i = 0; i < kSteps; ++i) {
    const double value = above / kStep;
    if (holds(value)) {
      return last_that_holds(value, above, holds);
    }
    above = value;
  }
  return 0.0;
}

}  // namespace

double spectral_radius(const SampledDevice& device, const RenderedSpring& spring) {
  if (!is_covered(device)) {
    return std::numeric_limits<double>::infinity();
  }
  const Polynomial p = characteristic(device, spring);
  double largest = 0.0;
  for (std::size_t k = 0; k < p.degree; ++k) {
    largest = std::max(largest, std::fabs(p.c[k]));
  }
  return last_that_holds(1.0 + largest, 0.0,
                         [&](double radius) { return roots_lie_within(p, radius); });
}

// A polynomial z^d + ... whose roots lie within the unit circle has p(1) < 2^d, and a constant
// coefficient below 1. p(1) = (b1 + b2) K, b1 + b2 = mean T^2 / m; the constant one is b2 B / T.
double largest_stable_stiffness(const SampledDevice& device, double damping_Ns_per_m) {
  if (!is_covered(device)) {
    return 0.0;
  }
  const double step = device.step_s;
  const Decay d = decay(device.damping_Ns_per_m * step / device.mass_kg);
  const double hopeless =
      std::ldexp(device.mass_kg, device.delay_ticks + 3) / (d.mean * step * step);
  return largest_that_holds(
      hopeless, [&](double stiffness) { return is_stable(device, {stiffness, damping_Ns_per_m}); });
}

double largest_stable_damping(const SampledDevice& device, double stiffness_N_per_m) {
  if (!is_covered(device)) {
    return 0.0;
  }
  const double step = device.step_s;
  const Decay d = decay(device.damping_Ns_per_m * step / device.mass_kg);
  const double hopeless = device.mass_kg / ((d.mean - d.rest) * step);
  return largest_that_holds(
      hopeless, [&](double damping) { return is_stable(device, {stiffness_N_per_m, damping}); });
}

}  // namespace tactus::rendering
