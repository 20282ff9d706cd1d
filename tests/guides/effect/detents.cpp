#include "rendering/effects/laws/detents.h"

#include <algorithm>
#include <numbers>

#include "rendering/geometry/portable_math.h"

namespace tactus::rendering {
namespace {

double radians_per_m(const Detents& law) {
  return 2.0 * std::numbers::pi / law.pitch_m;
}

}  // namespace

LawForce force_of(const Detents& law, const LawInput& input) {
  const double along = law.direction_W.dot(input.tool.p_W);
  const double most = std::min(law.amplitude_N, input.max_force_N);
  return {.elastic_W = -most * sine_cosine(radians_per_m(law) * along).sine * law.direction_W};
}

double stored_by(const Detents& law, const LawPlace& place) {
  const double along = law.direction_W.dot(place.p_W);
  const double most = std::min(law.amplitude_N, place.max_force_N);
  return most / radians_per_m(law) * (1.0 - sine_cosine(radians_per_m(law) * along).cosine);
}

LawSlopes steepest_of(const Detents& law, double max_force_N) {
  return {.stiffness_N_per_m = std::min(law.amplitude_N, max_force_N) * radians_per_m(law)};
}

}  // namespace tactus::rendering
