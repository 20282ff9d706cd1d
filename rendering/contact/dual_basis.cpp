#include "rendering/contact/dual_basis.h"

#include <Eigen/Geometry>

namespace tactus::rendering {
namespace {

// Normals with a smaller squared sine between them, or a smaller squared volume around them, count
// as parallel.
constexpr double kNearlyParallel = 1e-6;

DualBasis dual_of_two(const Vec3& n0, const Vec3& n1) {
  const double cosine = n0.dot(n1);
  const double squared_sine = 1.0 - cosine * cosine;
  if (squared_sine < kNearlyParallel) {
    return {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  }
  return {(n0 - cosine * n1) / squared_sine, (n1 - cosine * n0) / squared_sine, Vec3::Zero()};
}

DualBasis dual_of_three(const Vec3& n0, const Vec3& n1, const Vec3& n2) {
  const Vec3 m0 = n1.cross(n2);
  const double volume = n0.dot(m0);
  if (volume * volume < kNearlyParallel) {
    return {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  }
  return {m0 / volume, n2.cross(n0) / volume, n0.cross(n1) / volume};
}

}  // namespace

DualBasis dual_basis(const ProxyRest& rest) {
  const auto normal = [&](std::size_t i) -> const Vec3& { return rest.planes[i].plane.normal; };
  if (rest.plane_count == 1) {
    return {normal(0), Vec3::Zero(), Vec3::Zero()};
  }
  return rest.plane_count == 2 ? dual_of_two(normal(0), normal(1))
                               : dual_of_three(normal(0), normal(1), normal(2));
}

}  // namespace tactus::rendering
