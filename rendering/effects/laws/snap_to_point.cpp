#include "rendering/effects/laws/snap_to_point.h"

namespace tactus::rendering {

namespace {

Vec3 toward(const SnapToPoint& law, const Vec3& p) {
  return law.point_W - p;
}

}  // namespace

LawForce force_of(const SnapToPoint& law, const LawInput& input) {
  return snap(law.law, toward(law, input.tool.p_W), input.tool.v_W, input.max_force_N);
}

double stored_by(const SnapToPoint& law, const LawPlace& place) {
  return snap_energy(law.law, toward(law, place.p_W).norm(), place.max_force_N);
}

LawSlopes steepest_of(const SnapToPoint& law, double /*max_force_N*/) {
  return steepest_of(law.law);
}

}  // namespace tactus::rendering
