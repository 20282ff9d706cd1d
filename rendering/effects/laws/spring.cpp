#include "rendering/effects/laws/spring.h"

namespace tactus::rendering {

LawForce force_of(const Spring& law, const LawInput& input) {
  const Vec3 pull = law.stiffness_N_per_m * (law.anchor_W - input.tool.p_W);
  return {.elastic_W = bounded(pull, input.max_force_N)};
}

double stored_by(const Spring& law, const LawPlace& place) {
  return spring_energy(law.stiffness_N_per_m, (law.anchor_W - place.p_W).norm(), place.max_force_N);
}

LawSlopes steepest_of(const Spring& law, double /*max_force_N*/) {
  return {.stiffness_N_per_m = law.stiffness_N_per_m};
}

}  // namespace tactus::rendering
