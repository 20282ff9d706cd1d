#include "rendering/effects/laws/stick_slip.h"

#include <algorithm>

namespace tactus::rendering {

LawForce force_of(const StickSlip& law, const LawInput& input) {
  const double most = std::min(law.break_force_N, input.max_force_N);
  const Vec3 pull = law.stiffness_N_per_m * (input.state.anchor_W - input.tool.p_W);
  if (pull.squaredNorm() > most * most) {
    input.state.anchor_W = input.tool.p_W;
    return {};
  }
  return {.elastic_W = pull};
}

double stored_by(const StickSlip& law, const LawPlace& place) {
  if (!place.state.started) {
    return 0.0;
  }
  const double most = std::min(law.break_force_N, place.max_force_N);
  const double pull = law.stiffness_N_per_m * (place.state.anchor_W - place.p_W).norm();
  return pull > most ? 0.0 : 0.5 * pull * pull / law.stiffness_N_per_m;
}

LawSlopes steepest_of(const StickSlip& law, double /*max_force_N*/) {
  return {.stiffness_N_per_m = law.stiffness_N_per_m};
}

}  // namespace tactus::rendering
