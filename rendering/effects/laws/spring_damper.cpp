#include "rendering/effects/laws/spring_damper.h"

namespace tactus::rendering {

LawForce force_of(const SpringDamper& law, const LawInput& input) {
  LawForce force = force_of(law.spring, input);
  force.damping_W = -law.damping_Ns_per_m * input.tool.v_W;
  return force;
}

double stored_by(const SpringDamper& law, const LawPlace& place) {
  return stored_by(law.spring, place);
}

LawSlopes steepest_of(const SpringDamper& law, double /*max_force_N*/) {
  return {.stiffness_N_per_m = law.spring.stiffness_N_per_m,
          .damping_Ns_per_m = law.damping_Ns_per_m};
}

}  // namespace tactus::rendering
