// With the dual basis m_i of the normals and the rise r_i of plane i's force, the gradient is
//
//   dK/ds = sum_i dK/dpressure_i m_i
//         = 2 sum_i (pressure_i (K_i - K) + r_i) m_i / (sum_j pressure_j^2)
#include "rendering/contact/corner_spring.h"

#include <algorithm>

#include "rendering/contact/dual_basis.h"
#include "rendering/geometry/tangential.h"

namespace tactus::rendering {
namespace {

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

// Returns the length of the stretch along the one plane or both, m.
double lag_m(const ProxyRest& rest, const Vec3& stretch_W) {
  const Vec3& n = rest.planes[0].plane.normal;
  return rest.plane_count == 1 ? (stretch_W - n.dot(stretch_W) * n).norm()
                               : crease_between(n, rest.planes[1].plane.normal).dot(stretch_W);
}

// Returns the square of the lag, in lengths of the stretch over the planes. Between three planes
// there is none. Where force shading has lifted the goal toward the proxy, the pressures are those
// of a shallower tool, and the lag is to be shallower with them.
double squared_lag(const ProxyRest& rest, const Vec3& stretch_W) {
  const double depth = stretch_W.dot(rest.normal_W);
  if (rest.plane_count == 3 || !(depth > 0.0)) {
    return 0.0;
  }
  const double lag = lag_m(rest, stretch_W) / depth;
  return std::min(lag * lag, kMostLag * kMostLag);
}

}  // namespace

CornerSpring corner_spring(const ProxyRest& rest, const std::array<PlaneSpring, 3>& springs,
                           const Vec3& stretch_W) {
  CornerSpring spring;
  if (rest.plane_count == 0) {
    return spring;
  }
  double softest = springs[0].stiffness_N_per_m;
  double hardest = softest;
  double squares = 0.0;
  double weighted = 0.0;
  bool rises = false;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const double square = rest.pressure_m[i] * rest.pressure_m[i];
    squares += square;
    weighted += square * springs[i].stiffness_N_per_m;
    softest = std::min(softest, springs[i].stiffness_N_per_m);
    hardest = std::max(hardest, springs[i].stiffness_N_per_m);
    rises = rises || springs[i].rise_N != 0.0;
  }
  spring.stiffness_N_per_m = hardest;
  if ((softest == hardest && !rises) || !(squares > 0.0)) {
    return spring;
  }
  spring.stiffness_N_per_m = weighted / squares;
  const DualBasis dual = dual_basis(rest);
  Vec3 over_planes = Vec3::Zero();
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const double pressure = rest.pressure_m[i];
    over_planes += pressure * rest.planes[i].plane.normal;
    spring.sideways_W +=
        (pressure * (springs[i].stiffness_N_per_m - spring.stiffness_N_per_m) + springs[i].rise_N) *
        dual[i];
  }
  const double by_lag = 1.0 + squared_lag(rest, stretch_W);
  const double share =
      softest == hardest ? 1.0 : share_of_sideways(rest, dual, softest, hardest, by_lag);
  spring.sideways_W *= share * by_lag * over_planes.squaredNorm() / squares;
  return spring;
}

}  // namespace tactus::rendering
