#include "rendering/objects/object_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

namespace tactus::rendering {
namespace {

// The range of masses and moments, kg and kg m^2, and the least product of the principal moments
// over the cube of the largest: a rod a thousand times as long as it is thick is within it. Beyond,
// rounding would decide how a body answers.
constexpr double kSmallestInertia = 1e-18;
constexpr double kSmallestMass = 1e-9;
constexpr double kLargest = 1e9;
constexpr double kThinnest = 1e-9;
// The largest damping, 1/s.
constexpr double kMostDamping = 1e6;

// Returns true if the principal moments are those of a distribution of mass: T = tr(I)/2 - I is
// its second moment, which is positive definite, or nearly singular for a flat body.
bool is_inertia(const Mat3& inertia) {
  const double size = inertia.norm();
  const bool is_in_range = size >= kSmallestInertia && size <= kLargest;
  if (!is_in_range) {
    return false;
  }
  const double slack = 1e-9 * size;
  const Mat3 moment = 0.5 * inertia.trace() * Mat3::Identity() - inertia + slack * Mat3::Identity();
  const double second = moment(0, 0) * moment(1, 1) - moment(0, 1) * moment(1, 0);
  return (inertia - inertia.transpose()).norm() <= slack && inertia(0, 0) > 0.0 &&
         inertia.determinant() > kThinnest * size * size * size && moment(0, 0) > 0.0 &&
         second > 0.0 && moment.determinant() > 0.0;
}

}  // namespace

bool valid(const BodyMass& mass) {
  const std::array numbers{mass.mass_kg, mass.linear_damping_per_s, mass.angular_damping_per_s};
  const bool finite = std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }) &&
                      mass.center_O.allFinite() && mass.inertia_C.allFinite();
  const auto is_damping = [](double damping) { return damping >= 0.0 && damping <= kMostDamping; };
  return finite && mass.mass_kg >= kSmallestMass && mass.mass_kg <= kLargest &&
         is_damping(mass.linear_damping_per_s) && is_damping(mass.angular_damping_per_s) &&
         is_inertia(mass.inertia_C);
}

}  // namespace tactus::rendering
