// The energy of a body, and the work that a finger does on it.
#pragma once

#include "rendering/bodies/rigid_body.h"
#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Returns the energy of a body's place in a gravity (m/s^2), J; it is 0 where the centre of mass is
// at the world's origin.
double potential_energy_J(const RigidBody& body, const Vec3& gravity_W);

// Returns the work of a steady force (N) at a point of a body (m) while the body goes from one pose
// to another, J.
double work_on_body_J(const Vec3& force_W, const Vec3& point_W, const RigidPose& before,
                      const RigidPose& after);

}  // namespace tactus::rendering
