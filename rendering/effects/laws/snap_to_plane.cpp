#include "rendering/effects/laws/snap_to_plane.h"

namespace tactus::rendering {

namespace {

Vec3 toward(const SnapToPlane& law, const Vec3& p) {
  return (law.point_W - p).dot(law.normal_W) * law.normal_W;
}

}  // namespace

LawForce force_of(const SnapToPlane& law, const LawInput& input) {
  const Vec3 across = input.tool.v_W.dot(law.normal_W) * law.normal_W;
  return snap(law.law, toward(law, input.tool.p_W), across, input.max_force_N);
}

double stored_by(const SnapToPlane& law, const LawPlace& place) {
  return snap_energy(law.law, toward(law, place.p_W).norm(), place.max_force_N);
}

LawSlopes steepest_of(const SnapToPlane& law, double /*max_force_N*/) {
  return steepest_of(law.law);
}

}  // namespace tactus::rendering
