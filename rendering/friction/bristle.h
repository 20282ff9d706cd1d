// The common part of the models: the motion of a tick, and a bristle that yields along it.
//
// A bristle of stiffness sigma0 that yields toward the level G obeys, per length s of a straight
// path in the direction u, with f = sigma0 z,
//   df/ds = sigma0 (u - f / G),
// a linear equation also for vectors f and u. With a = sigma0 s / G its solution is
//   f(s) = u G + (f(0) - u G) exp(-a),
// and its mean over the path
//   u G + (f(0) - u G) (1 - exp(-a)) / a.
// f stays within the convex hull of f(0) and u G. The work, mean times path, is the change of f^2 /
// (2 sigma0) plus the integral of f^2 / G over the path, which is the heat and never negative.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "rendering/friction/friction_parameters.h"
#include "rendering/friction/tangent.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::rendering {

template <typename Vector>
struct FrictionTick {
  Vector displacement_m = zero_tangent<Vector>();
  double path_m = 0.0;  // its length
  double speed_m_per_s = 0.0;
  double normal_force_N = 0.0;  // > 0
  double step_s = 0.0;          // > 0
};

// The elastic force sigma0 z over a tick.
template <typename Vector>
struct ElasticStep {
  Vector end_N = zero_tangent<Vector>();
  Vector mean_N = zero_tangent<Vector>();
  Vector bent_N = zero_tangent<Vector>();  // the change that the motion made; cuts are left out
  bool slipping = false;
  bool left_band = false;  // see FrictionMemory
};

// exp(-a), its mean from 0 to a, and (1 - that mean) / a, all without cancellation; a >= 0.
struct Decay {
  double left = 1.0;
  double mean = 1.0;
  double rest = 0.5;
};

inline Decay decay(double a) {
  constexpr double kSeriesEnds = 0.125;  // the first term left out is below 2e-16 there
  constexpr double kAllGone = 40.0;      // exp(-40) is below a double's rounding of 1
  // 2 / (k + 2)!: `rest` is half the sum over k of these times (-a)^k.
  constexpr std::array kTerms{1.0,           1.0 / 3,        1.0 / 12,        1.0 / 60,
                              1.0 / 360,     1.0 / 2520,     1.0 / 20160,     1.0 / 181440,
                              1.0 / 1814400, 1.0 / 19958400, 1.0 / 239500800, 1.0 / 3113510400};
  Decay result;
  if (a < kSeriesEnds) {
    // Even and odd powers are two chains that do not wait for each other.
    double even = 0.0;
    double odd = 0.0;
    for (std::size_t k = kTerms.size(); k > 0; k -= 2) {
      even = kTerms[k - 2] + a * a * even;
      odd = kTerms[k - 1] + a * a * odd;
    }
    result.rest = 0.5 * (even - a * odd);
    result.mean = 1.0 - a * result.rest;
    result.left = 1.0 - a * result.mean;
    return result;
  }
  result.left = a < kAllGone ? exponential(-a) : 0.0;
  result.mean = (1.0 - result.left) / a;
  result.rest = (1.0 - result.mean) / a;
  return result;
}

// Moves the bristle along `motion`, a straight path of the length `path_m`, from the elastic force
// f. level_N must be > 0.
template <typename Vector>
ElasticStep<Vector> yield_toward(double level_N, double stiffness_N_per_m, const Vector& f,
                                 const Vector& motion, double path_m) {
  const Decay d = decay(stiffness_N_per_m * path_m / level_N);
  const Vector stretch = stiffness_N_per_m * motion;
  ElasticStep<Vector> result;
  result.end_N = d.left * f + d.mean * stretch;
  result.mean_N = d.mean * f + d.rest * stretch;
  result.bent_N = result.end_N - f;
  result.slipping = 2.0 * length(result.bent_N) < length(stretch);
  return result;
}

// f shortened to `most_N`.
template <typename Vector>
Vector cut_to(const Vector& f, double most_N) {
  const double size = length(f);
  return size > most_N ? Vector{(most_N / size) * f} : f;
}

}  // namespace tactus::rendering
