// What makes an object a body that moves by forces (rendering/bodies).
#pragma once

#include <cstdint>
#include <limits>

#include "rendering/geometry/convex_hull.h"
#include "rendering/geometry/vector.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// The mass properties of a body and what slows it down.
struct BodyMass {
  // The mass, kg, > 0.
  double mass_kg = 1.0;
  // The centre of mass in the object's frame, m.
  Vec3 center_O = Vec3::Zero();
  // The inertia about the centre of mass, kg m^2: symmetric and positive definite; axes of O.
  Mat3 inertia_C = Mat3::Identity();
  // The shares of the velocity and of the angular momentum that are lost in a second, 1/s, >= 0.
  double linear_damping_per_s = 0.0;
  double angular_damping_per_s = 0.0;
};

// Returns true if the numbers are finite, in the ranges of object_body.cpp, and those of a body
// that exists: the inertia is symmetric to 1e-9 of its size, and no principal moment exceeds the
// sum of the two others by more.
bool valid(const BodyMass& mass);

// The gravity of the earth by definition (CGPM 1901), m/s^2, and downward in the world.
inline constexpr double kStandardGravity_m_per_s2 = 9.80665;
inline Vec3 standard_gravity_W() {
  return {0.0, -kStandardGravity_m_per_s2, 0.0};
}
// The largest gravity of a scene, m/s^2.
inline constexpr double kMostGravity_m_per_s2 = 1000.0;

// The least effective modulus of soft fingers, Pa: softer than any gel.
inline constexpr double kLeastFingerModulus_Pa = 100.0;
// Returns true if fingers may have this effective modulus: 0 stands for fingers that touch in a
// point. NaN may not.
constexpr bool is_finger_modulus(double modulus_Pa) {
  return modulus_Pa == 0.0 ||
         (modulus_Pa >= kLeastFingerModulus_Pa && modulus_Pa <= std::numeric_limits<double>::max());
}

// The shortest rest after which bodies may fall asleep, s. A body that turns back in its flight is
// at rest for less than a millisecond.
inline constexpr double kLeastSleepAfter_s = 0.01;
// Returns true if bodies may fall asleep after such a rest; 0 stands for never. NaN may not.
constexpr bool is_sleep_time(double after_s) {
  return after_s == 0.0 ||
         (after_s >= kLeastSleepAfter_s && after_s <= std::numeric_limits<double>::max());
}

// The largest torque of rolling or spinning friction over the normal force, m.
inline constexpr double kMostTurnFriction_m = 1.0;

// A convex part of a body: a hull, or a primitive where the hull has no vertices. Frame O.
struct BodyPart {
  ConvexHull hull;
  Primitive primitive;
};

// A body as a scene describes it. It begins where the scene gives the object.
struct ObjectBody {
  BodyMass mass;
  // The collision shape of a mesh; a primitive is its own.
  ConvexHull hull;
  // The parts by which it meets others instead: so many of the scene's parts, from the first on.
  std::uint32_t first_part = 0;
  std::uint32_t part_count = 0;
  // The axes of the object as the scene gives it, which its numbers refer to, in O.
  Mat3 axes_O = Mat3::Identity();
  // The share of the approaching speed that is left after a bounce, 0 to 1.
  double restitution = 0.0;
  // The torques that resist rolling, and spinning about the normal of a contact, over its normal
  // force, m: 0 to kMostTurnFriction_m.
  double rolling_friction_m = 0.0;
  double spinning_friction_m = 0.0;
  // The velocity of the centre of mass at the start (world frame, m/s), and the angular velocity
  // (axes of O, rad/s).
  Vec3 velocity_W = Vec3::Zero();
  Vec3 angular_velocity_O = Vec3::Zero();
};

}  // namespace tactus::rendering
