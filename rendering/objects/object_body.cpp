#include "rendering/objects/object_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

namespace tactus::rendering {
namespace {

// Returns true if the principal moments are those of a distribution of mass: T = tr(I)/2 - I is
// its second moment, which is positive definite, or nearly singular for a flat body.
bool is_inertia(const Mat3& inertia) {
  const double size = inertia.norm();
  const double slack = 1e-9 * size;
  const Mat3 moment = 0.5 * inertia.trace() * Mat3::Identity() - inertia + slack * Mat3::Identity();
  const double second = moment(0, 0) * moment(1, 1) - moment(0, 1) * moment(1, 0);
  return (inertia - inertia.transpose()).norm() <= slack && inertia(0, 0) > 0.0 &&
         inertia.determinant() > 0.0 && moment(0, 0) > 0.0 && second > 0.0 &&
         moment.determinant() > 0.0;
}

}  // namespace

bool valid(const BodyMass& mass) {
  const std::array numbers{mass.mass_kg, mass.linear_damping_per_s, mass.angular_damping_per_s};
  const bool finite = std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }) &&
                      mass.center_O.allFinite() && mass.inertia_C.allFinite();
  return finite && mass.mass_kg > 0.0 && mass.linear_damping_per_s >= 0.0 &&
         mass.angular_damping_per_s >= 0.0 && is_inertia(mass.inertia_C);
}

}  // namespace tactus::rendering
