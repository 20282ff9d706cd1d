#include "rendering/effects/laws/fluid_drag.h"

#include <cmath>

namespace tactus::rendering {

LawForce force_of(const FluidDrag& law, const LawInput& input) {
  const double depth = -sample(law.volume, input.tool.p_W).distance_m;
  if (depth <= 0.0) {
    return {};
  }
  const double share = depth < law.rim_m ? depth / law.rim_m : 1.0;
  const double drag = law.linear_Ns_per_m + law.quadratic_Ns2_per_m2 * input.tool.v_W.norm();
  return {.damping_W = -share * drag * input.tool.v_W};
}

double stored_by(const FluidDrag& /*law*/, const LawPlace& /*place*/) {
  return 0.0;
}

// The damping is the slope of the drag at the speed at which it reaches its largest force, where it
// is steepest.
LawSlopes steepest_of(const FluidDrag& law, double max_force_N) {
  const double linear = law.linear_Ns_per_m;
  return {.damping_Ns_per_m =
              std::sqrt(linear * linear + 4.0 * law.quadratic_Ns2_per_m2 * max_force_N)};
}

}  // namespace tactus::rendering
