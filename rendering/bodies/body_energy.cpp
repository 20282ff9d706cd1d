#include "rendering/bodies/body_energy.h"

namespace tactus::rendering {

double potential_energy_J(const RigidBody& body, const Vec3& gravity_W) {
  return -body.mass().mass_kg * gravity_W.dot(body.motion().center_W);
}

double work_on_body_J(const Vec3& force_W, const Vec3& point_W, const RigidPose& before,
                      const RigidPose& after) {
  return force_W.dot(after.point(before.point_in(point_W)) - point_W);
}

}  // namespace tactus::rendering
