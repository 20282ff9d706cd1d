#include "rendering/needle/tissue.h"

#include <algorithm>
#include <cmath>

#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Comparisons with a value that is not a number are false.
bool in_range(double value, double most) {
  return value >= 0.0 && value <= most;
}

bool valid(const ShaftFriction& friction) {
  return in_range(friction.static_N_per_m, kMostNeedleStiffness) &&
         in_range(friction.dynamic_N_per_m, friction.static_N_per_m) &&
         in_range(friction.viscous_Ns_per_m2, kMostNeedleStiffness);
}

}  // namespace

bool valid(const Needle& needle) {
  return in_range(needle.length_m, kWorldBound_m) &&
         (needle.length_m == 0.0 ||
          (std::abs(needle.axis_W.squaredNorm() - 1.0) <= 1e-9 && needle.width_m > 0.0 &&
           needle.width_m <= kMaxToolRadius_m && needle.tip_stiffness_N_per_m > 0.0 &&
           needle.tip_stiffness_N_per_m <= kMostNeedleStiffness));
}

bool valid(const Tissue& tissue, const Needle& needle) {
  // Rounding in the baked numbers.
  constexpr double kSlack = 1.0 + 1e-9;
  return in_range(tissue.stiffness_N_per_m, kMostNeedleStiffness) &&
         in_range(tissue.stiffness_N_per_m2, kMostNeedleStiffness) &&
         in_range(tissue.puncture_force_N, kMostNeedleForce_N) &&
         (tissue.puncture_force_N == 0.0 ||
          tissue.stiffness_N_per_m + tissue.stiffness_N_per_m2 > 0.0) &&
         in_range(tissue.cutting_force_N, kMostNeedleForce_N) &&
         in_range(tissue.toughness_J_per_m2, kMostNeedleStiffness) &&
         fracture_force_N(tissue, needle) <= kSlack * tissue.cutting_force_N && valid(tissue.in) &&
         valid(tissue.out) && tissue.shaft_stiffness_N_per_m2 > 0.0 &&
         tissue.shaft_stiffness_N_per_m2 <= kMostNeedleStiffness &&
         in_range(tissue.lateral_stiffness_N_per_m2, kMostNeedleStiffness) &&
         in_range(tissue.relaxation_s, kMostNeedleForce_N) &&
         in_range(tissue.residual_m, kSlack * puncture_depth_m(tissue));
}

// The positive root of quadratic d^2 + linear d - force, in the form that does not cancel.
double puncture_depth_m(const Tissue& tissue) {
  const double linear = tissue.stiffness_N_per_m;
  const double force = tissue.puncture_force_N;
  if (!(force > 0.0)) {
    return 0.0;
  }
  return 2.0 * force /
         (linear + std::sqrt(linear * linear + 4.0 * tissue.stiffness_N_per_m2 * force));
}

double membrane_force_N(const Tissue& tissue, double depth_m) {
  return depth_m * (tissue.stiffness_N_per_m + depth_m * tissue.stiffness_N_per_m2);
}

double membrane_energy_J(const Tissue& tissue, double depth_m) {
  return depth_m * depth_m *
         (tissue.stiffness_N_per_m / 2.0 + depth_m * tissue.stiffness_N_per_m2 / 3.0);
}

double least_residual_m(const Tissue& tissue, const Needle& needle) {
  const double depth = puncture_depth_m(tissue);
  const double fracture_N = fracture_force_N(tissue, needle);
  const double energy = membrane_energy_J(tissue, depth);
  return fracture_N * depth <= energy ? 0.0 : depth - energy / fracture_N;
}

// The way x that the energy pays for: cutting x + friction x^2 / 2 = energy.
double balanced_residual_m(const Tissue& tissue) {
  const double depth = puncture_depth_m(tissue);
  const double energy = membrane_energy_J(tissue, depth);
  const double cutting = tissue.cutting_force_N;
  const double root =
      cutting + std::sqrt(cutting * cutting + 2.0 * tissue.in.dynamic_N_per_m * energy);
  return root * depth <= 2.0 * energy ? 0.0 : depth - 2.0 * energy / root;
}

NeedleImpedance largest_impedance(const NeedleScene& scene) {
  const Needle& needle = scene.needle;
  if (needle.length_m <= 0.0 || scene.tissues.empty()) {
    return {};
  }
  double membrane = 0.0;
  double shaft = 0.0;
  double across = 0.0;
  double viscous = 0.0;
  for (const Tissue& tissue : scene.tissues) {
    membrane = std::max(membrane, tissue.stiffness_N_per_m +
                                      2.0 * tissue.stiffness_N_per_m2 * puncture_depth_m(tissue));
    shaft = std::max(shaft, tissue.shaft_stiffness_N_per_m2);
    across = std::max(across, tissue.lateral_stiffness_N_per_m2);
    viscous = std::max({viscous, tissue.in.viscous_Ns_per_m2, tissue.out.viscous_Ns_per_m2});
  }
  const double along = std::max(membrane, needle.tip_stiffness_N_per_m) + shaft * needle.length_m;
  return {.stiffness_N_per_m = std::max(along, across * needle.length_m),
          .damping_Ns_per_m = viscous * needle.length_m};
}

}  // namespace tactus::rendering
