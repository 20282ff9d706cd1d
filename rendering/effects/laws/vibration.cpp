#include "rendering/effects/laws/vibration.h"

#include <algorithm>

namespace tactus::rendering {

LawForce force_of(const Vibration& law, const LawInput& input) {
  const double turns = law.frequency_Hz * input.dt_s;
  if (!(turns < 0.5)) {
    return {};
  }
  const double push = std::min(law.amplitude_N, input.max_force_N) * sine(input.state.phase);
  input.state.phase += phase_of_turns(turns);
  return {.elastic_W = push * law.direction_W};
}

double stored_by(const Vibration& /*law*/, const LawPlace& /*place*/) {
  return 0.0;
}

LawSlopes steepest_of(const Vibration& /*law*/, double /*max_force_N*/) {
  return {};
}

}  // namespace tactus::rendering
