#include <cmath>

#include "rendering/effects/laws.h"

namespace tactus::rendering {
namespace {

bool not_negative(double x) {
  return std::isfinite(x) && x >= 0.0;
}
bool positive(double x) {
  return std::isfinite(x) && x > 0.0;
}

bool unit(const Vec3& v) {
  constexpr double kTolerance = 1e-9;
  return std::abs(v.squaredNorm() - 1.0) <= kTolerance;  // false for NaN
}

bool valid_snap(const SnapLaw& law) {
  return not_negative(law.stiffness_N_per_m) && not_negative(law.damping_Ns_per_m) &&
         positive(law.capture_m);
}

}  // namespace

bool valid_law(const Spring& law) {
  return law.anchor_W.allFinite() && not_negative(law.stiffness_N_per_m);
}

bool valid_law(const SpringDamper& law) {
  return valid_law(law.spring) && not_negative(law.damping_Ns_per_m);
}

bool valid_law(const FluidDrag& law) {
  return valid(law.volume) && not_negative(law.linear_Ns_per_m) &&
         not_negative(law.quadratic_Ns2_per_m2) && not_negative(law.rim_m);
}

bool valid_law(const Magnet& law) {
  return law.pole_W.allFinite() && std::isfinite(law.strength_N) && positive(law.core_m);
}

bool valid_law(const ConstantField& law) {
  return law.force_W.allFinite();
}

bool valid_law(const Vibration& law) {
  return unit(law.direction_W) && not_negative(law.amplitude_N) && not_negative(law.frequency_Hz);
}

bool valid_law(const StickSlip& law) {
  return positive(law.stiffness_N_per_m) && not_negative(law.break_force_N);
}

bool valid_law(const SnapToPoint& law) {
  return law.point_W.allFinite() && valid_snap(law.law);
}

bool valid_law(const SnapToLine& law) {
  return law.point_W.allFinite() && unit(law.direction_W) && valid_snap(law.law);
}

bool valid_law(const SnapToPlane& law) {
  return law.point_W.allFinite() && unit(law.normal_W) && valid_snap(law.law);
}

}  // namespace tactus::rendering
