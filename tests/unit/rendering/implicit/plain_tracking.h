// The tracking of an implicit surface as the textbook has it (Salisbury and Tarr, "Haptic rendering
// of surfaces defined by implicit functions", ASME DSC 61, 1997), kept with its faults so that they
// can be shown: pressed deeper than the radius of a hollow, it swings between two points; and its
// point may jump to another sheet. The controller uses rendering/contact/implicit_tracking.h.
#pragma once

#include "rendering/surface/formula.h"

namespace tactus::rendering {

struct Seed {
  Vec3 point = Vec3::Zero();
  bool converged = false;  // false: a vanishing gradient, or too many steps
};

// The surface point that Newton's steps along the gradient reach from a start near the surface, in
// the formula's units: p <- p - f grad f / |grad f|^2, until a step is below 1e-13.
Seed seed(const FormulaView& formula, const Vec3& start);

// Computes one tick: projects the tool on the tangent plane at the surface contact point, and seeks
// the surface point from there.
Seed plain_tracking_step(const FormulaView& formula, const Vec3& contact, const Vec3& tool);

}  // namespace tactus::rendering
