// With the dual basis m_i of the normals, m_i . n_j = 1 for i = j and 0 otherwise, the gradient is
//
//   dK/ds = sum_i dK/dpressure_i m_i = 2 sum_i pressure_i (K_i - K) m_i / (sum_j pressure_j^2)
#include "rendering/contact/corner_spring.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "rendering/geometry/tangential.h"

namespace tactus::rendering {
namespace {

// Normals with a smaller squared sine between them, or a smaller squared volume around them, count
// as parallel: the second part of the force would be lessened to nothing.
constexpr double kNearlyParallel = 1e-6;

using DualBasis = std::array<Vec3, 3>;

// Returns the dual basis of two normals, in their plane; zeros if they are parallel.
DualBasis dual_of_two(const Vec3& n0, const Vec3& n1) {
  const double cosine = n0.dot(n1);
  const double squared_sine = 1.0 - cosine * cosine;
  if (squared_sine < kNearlyParallel) {
    return {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  }
  return {(n0 - cosine * n1) / squared_sine, (n1 - cosine * n0) / squared_sine, Vec3::Zero()};
}

// Returns the dual basis of three normals; zeros if they lie in one plane.
DualBasis dual_of_three(const Vec3& n0, const Vec3& n1, const Vec3& n2) {
  const Vec3 m0 = n1.cross(n2);
  const double volume = n0.dot(m0);
  if (volume * volume < kNearlyParallel) {
    return {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  }
  return {m0 / volume, n2.cross(n0) / volume, n0.cross(n1) / volume};
}

// Returns the largest cosine between two of the normals.
double largest_cosine(const ProxyRest& rest) {
  double largest = -1.0;
  for (std::size_t i = 1; i < rest.plane_count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      largest = std::max(largest, rest.planes[i].plane.normal.dot(rest.planes[j].plane.normal));
    }
  }
  return largest;
}

// Returns the share of the second part that is applied. Where the softest surface holds nearly
// alone, the second part has the stiffness (K_hard - K_soft) m^2, and the first K_soft; their sum
// is at most twice K_hard. Between normals less than 60 degrees apart the second part is stiffest
// where both surfaces hold, by about the inverse cube of 1 - cosine. A lag makes all of it stiffer
// by `by_lag`.
double share_of_sideways(const ProxyRest& rest, const DualBasis& dual, double softest,
                         double hardest, double by_lag) {
  double longest = 1.0;  // squared
  for (const Vec3& m : dual) {
    longest = std::max(longest, m.squaredNorm());
  }
  const double at_softest = (2.0 * hardest - softest) / ((hardest - softest) * longest * by_lag);
  constexpr double kWholeFrom = 0.49;  // 1 - cosine; 59.3 degrees
  const double apart = (1.0 - largest_cosine(rest)) / kWholeFrom;
  return std::min({1.0, at_softest, apart * apart * apart / (by_lag * by_lag)});
}

// Returns the square of the lag, in lengths of the stretch over the planes. Between three planes
// there is none. Where force shading has lifted the goal toward the proxy, the pressures are those
// of a shallower tool, and the lag is to be shallower with them.
double squared_lag(const ProxyRest& rest, const Vec3& stretch_W) {
  const double depth = stretch_W.dot(rest.normal_W);
  if (rest.plane_count != 2 || !(depth > 0.0)) {
    return 0.0;
  }
  const Vec3 crease = crease_between(rest.planes[0].plane.normal, rest.planes[1].plane.normal);
  const double lag = crease.dot(stretch_W) / depth;
  return std::min(lag * lag, kMostLag * kMostLag);
}

}  // namespace

CornerSpring corner_spring(const ProxyRest& rest, const std::array<double, 3>& stiffness_N_per_m,
                           const Vec3& stretch_W) {
  CornerSpring spring;
  if (rest.plane_count == 0) {
    return spring;
  }
  const auto* const end = stiffness_N_per_m.begin() + rest.plane_count;
  const auto [softest, hardest] = std::minmax_element(stiffness_N_per_m.begin(), end);
  spring.stiffness_N_per_m = *hardest;
  if (*softest == *hardest) {
    return spring;
  }
  double squares = 0.0;
  double weighted = 0.0;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const double square = rest.pressure_m[i] * rest.pressure_m[i];
    squares += square;
    weighted += square * stiffness_N_per_m[i];
  }
  if (!(squares > 0.0)) {
    return spring;
  }
  spring.stiffness_N_per_m = weighted / squares;
  const auto& planes = rest.planes;
  const DualBasis dual =
      rest.plane_count == 2
          ? dual_of_two(planes[0].plane.normal, planes[1].plane.normal)
          : dual_of_three(planes[0].plane.normal, planes[1].plane.normal, planes[2].plane.normal);
  Vec3 over_planes = Vec3::Zero();
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const double pressure = rest.pressure_m[i];
    over_planes += pressure * planes[i].plane.normal;
    spring.sideways_W += pressure * (stiffness_N_per_m[i] - spring.stiffness_N_per_m) * dual[i];
  }
  const double by_lag = 1.0 + squared_lag(rest, stretch_W);
  spring.sideways_W *= share_of_sideways(rest, dual, *softest, *hardest, by_lag) * by_lag *
                       over_planes.squaredNorm() / squares;
  return spring;
}

}  // namespace tactus::rendering
