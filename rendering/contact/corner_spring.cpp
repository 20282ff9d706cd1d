// With the dual basis m_i of the normals, m_i . n_j = 1 for i = j and 0 otherwise, the gradient is
//
//   dK/ds = sum_i dK/dpressure_i m_i = 2 sum_i pressure_i (K_i - K) m_i / (sum_j pressure_j^2)
#include "rendering/contact/corner_spring.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace tactus::rendering {
namespace {

// Normals at a smaller sine, or around a smaller volume, count as parallel.
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
  if (volume * volume < kNearlyParallel * kNearlyParallel) {
    return {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  }
  return {m0 / volume, n2.cross(n0) / volume, n0.cross(n1) / volume};
}

}  // namespace

CornerSpring corner_spring(const ProxyRest& rest, const std::array<double, 3>& stiffness_N_per_m) {
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
  Vec3 stretch = Vec3::Zero();
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const double pressure = rest.pressure_m[i];
    stretch += pressure * planes[i].plane.normal;
    spring.sideways_W += pressure * (stiffness_N_per_m[i] - spring.stiffness_N_per_m) * dual[i];
  }
  spring.sideways_W *= stretch.squaredNorm() / squares;
  const double most_N = *hardest * stretch.norm();
  const double length_N = spring.sideways_W.norm();
  if (length_N > most_N) {
    spring.sideways_W *= most_N / length_N;
  }
  return spring;
}

}  // namespace tactus::rendering
