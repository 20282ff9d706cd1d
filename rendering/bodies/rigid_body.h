// A rigid body: its mass, its motion, and how an impulse changes that. The world frame W is
// inertial; O is the object's frame, C the body's with the same axes and its origin in the centre
// of mass.
#pragma once

#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"
#include "rendering/objects/motion.h"
#include "rendering/objects/object_body.h"

namespace tactus::rendering {

// No body is faster, m/s, and none begins to turn faster, rad/s.
inline constexpr double kFastestBody_m_per_s = 1000.0;
inline constexpr double kFastestBodyTurn_rad_per_s = 1e4;

// The motion of a body. The angular momentum is kept and not the angular velocity: without a torque
// its bits stay what they are.
struct BodyMotion {
  // The centre of mass in the world, m, and its velocity, m/s.
  Vec3 center_W = Vec3::Zero();
  Vec3 velocity_W = Vec3::Zero();
  // The axes of O in W.
  Mat3 rotation_WO = Mat3::Identity();
  // The angular momentum about the centre of mass, kg m^2/s.
  Vec3 angular_momentum_W = Vec3::Zero();
};

// A body that is computed: its mass, its motion, and what follows from both.
class RigidBody {
 public:
  RigidBody() = default;

  // Starts at a pose of the object with a velocity of the centre of mass (world frame, m/s) and an
  // angular velocity (axes of O, rad/s). The mass must be valid().
  RigidBody(const BodyMass& mass, const RigidPose& X_WO, const Vec3& velocity_W,
            const Vec3& angular_velocity_O);

  [[nodiscard]] const BodyMass& mass() const { return mass_; }
  [[nodiscard]] const BodyMotion& motion() const { return motion_; }
  // Sets the motion, and what follows from it.
  void set_motion(const BodyMotion& motion);
  // Sets the place alone, of the centre of mass and of the axes: that of the same body, moved.
  void take_place(const RigidBody& moved);

  // Returns the pose of the object, and its twist at the object's origin.
  [[nodiscard]] RigidPose pose() const;
  [[nodiscard]] Twist twist() const;
  // Returns the angular velocity in the world frame, rad/s.
  [[nodiscard]] const Vec3& angular_velocity_W() const { return angular_velocity_W_; }
  // Returns the velocity of the body's point at `p_W`, m/s.
  [[nodiscard]] Vec3 velocity_at(const Vec3& p_W) const {
    return motion_.velocity_W + angular_velocity_W_.cross(p_W - motion_.center_W);
  }

  // Changes the motion by an impulse, N s, and an impulse of torque about the centre of mass,
  // N m s; world frame.
  void push(const Vec3& impulse_W, const Vec3& torque_impulse_W);
  // Return the inertia about the centre of mass and its inverse in the world's axes, kg m^2.
  [[nodiscard]] Mat3 inertia_W() const {
    return motion_.rotation_WO * mass_.inertia_C * motion_.rotation_WO.transpose();
  }
  [[nodiscard]] const Mat3& inverse_inertia_W() const { return inverse_inertia_W_; }

  // Applies gravity (m/s^2) and the damping for `step_s`. Speeds above kFastestBody_m_per_s, and
  // turns of more than a radian in the step, are reduced to that.
  void accelerate(const Vec3& gravity_W, double step_s);
  // Moves the body without forces for `step_s`: the centre in a straight line, the rotation by
  // rotate_freely().
  void move(double step_s);

  // Returns the kinetic energy, J.
  [[nodiscard]] double kinetic_energy_J() const;

 private:
  // Computes the inverse inertia and the angular velocity of the present rotation.
  void follow_rotation();

  BodyMass mass_;
  Mat3 inverse_inertia_C_ = Mat3::Identity();
  BodyMotion motion_;
  // The inverse inertia in the world's axes, and the angular velocity, rad/s.
  Mat3 inverse_inertia_W_ = Mat3::Identity();
  Vec3 angular_velocity_W_ = Vec3::Zero();
};

// Returns the rotation of a body without torque after `step_s`.
//
// The body turns by the exact exponential about W = J (P + P') / 2, where J is the inverse inertia
// and P and P' are the angular momentum seen from the body before and after the step: an implicit
// midpoint rule (Hairer, Lubich and Wanner, "Geometric Numerical Integration", 2006, VII.5). A
// rotation about W leaves P' - P normal to W, so that P' J P' - P J P = 2 (P' - P) W = 0: it keeps
// the energy, and the momentum in the world as it does not touch it. Error: second order in the
// step. A body that turns by less than one radian in a step settles within the bounded iterations.
//
// `inverse_inertia_C` is in the body's axes; `momentum_W` is the angular momentum, kg m^2/s.
Mat3 rotate_freely(const Mat3& inverse_inertia_C, const Mat3& rotation_WO, const Vec3& momentum_W,
                   double step_s);

// Returns the rotation by the angle and about the axis of `turn`, rad: the exponential map. The
// bits are the same on every machine; |turn| is at most kLargestAngle.
Mat3 rotation_by(const Vec3& turn);

}  // namespace tactus::rendering
