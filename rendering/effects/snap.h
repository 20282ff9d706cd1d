// The draw to a target that SnapToPoint, SnapToLine and SnapToPlane share.
#pragma once

#include "rendering/effects/law.h"

namespace tactus::rendering {

// Draws the tool to a target at the distance r: K r up to half the capture distance, from there
// down to nothing at the capture distance, and damped by B within it.
struct SnapLaw {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  double capture_m = 0.01;  // > 0

  template <class Law, class Visitor>
  static void visit_fields(Law& law, Visitor& visit) {
    visit(kStiffnessField, law.stiffness_N_per_m);
    visit(kDampingField, law.damping_Ns_per_m);
    visit(
        NumberField{
            .key = "capture_m", .unit = "m", .range = FieldRange::above_zero, .example = "0.01"},
        law.capture_m);
  }
};

// `offset` leads from the tool to the target, `velocity` is the part of the tool's velocity that is
// damped, and `most` bounds the pull, N.
LawForce snap(const SnapLaw& law, const Vec3& offset, const Vec3& velocity, double most);

// Returns the integral of the pull from 0 to the distance r, J.
double snap_energy(const SnapLaw& law, double r, double most);

inline LawSlopes steepest_of(const SnapLaw& law) {
  return {.stiffness_N_per_m = law.stiffness_N_per_m, .damping_Ns_per_m = law.damping_Ns_per_m};
}

}  // namespace tactus::rendering
