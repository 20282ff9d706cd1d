#include "rendering/effects/laws/constant_field.h"

namespace tactus::rendering {

LawForce force_of(const ConstantField& law, const LawInput& input) {
  return {.elastic_W = bounded(law.force_W, input.max_force_N)};
}

double stored_by(const ConstantField& law, const LawPlace& place) {
  return -bounded(law.force_W, place.max_force_N).dot(place.p_W);
}

LawSlopes steepest_of(const ConstantField& /*law*/, double /*max_force_N*/) {
  return {};
}

}  // namespace tactus::rendering
