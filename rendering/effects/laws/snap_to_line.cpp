#include "rendering/effects/laws/snap_to_line.h"

namespace tactus::rendering {

namespace {

Vec3 toward(const SnapToLine& law, const Vec3& p) {
  const Vec3 offset = law.point_W - p;
  return offset - offset.dot(law.direction_W) * law.direction_W;
}

}  // namespace

LawForce force_of(const SnapToLine& law, const LawInput& input) {
  const Vec3 across = input.tool.v_W - input.tool.v_W.dot(law.direction_W) * law.direction_W;
  return snap(law.law, toward(law, input.tool.p_W), across, input.max_force_N);
}

double stored_by(const SnapToLine& law, const LawPlace& place) {
  return snap_energy(law.law, toward(law, place.p_W).norm(), place.max_force_N);
}

LawSlopes steepest_of(const SnapToLine& law, double /*max_force_N*/) {
  return steepest_of(law.law);
}

}  // namespace tactus::rendering
