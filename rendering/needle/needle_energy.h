// The account of the work of the hand on a needle.
#pragma once

namespace tactus::rendering {

// The account of one needle since the start. The work of the hand is the sum of all and of what is
// stored; nothing of it comes back but from the store.
struct NeedleEnergy {
  // The energy that cracks took, J, and their area, m^2.
  double fracture_J = 0.0;
  double crack_m2 = 0.0;
  // The energy that went into friction on the shaft and into spreading the tissue at the tip, J.
  double friction_J = 0.0;
  // The energy that punctures, relaxation and letting go set free, J: it goes into no force.
  double freed_J = 0.0;
};

}  // namespace tactus::rendering
