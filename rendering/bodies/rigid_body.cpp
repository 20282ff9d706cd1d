#include "rendering/bodies/rigid_body.h"

#include <cmath>

#include <Eigen/LU>

#include "rendering/geometry/portable_math.h"

namespace tactus::rendering {
namespace {

// The steps of the midpoint rule's iteration; each gains a factor of the angle of the step.
constexpr int kMidpointSteps = 64;

// Returns the matrix of v x.
Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

// The factors of Rodrigues' formula for a rotation by `turn`, an angle along its axis:
// R = (1 - across turn^2) 1 + along [turn x] + across turn turn'. They are sin(x)/x and
// (1 - cos x)/x^2 = (sin(x/2)/(x/2))^2 / 2, which lose no digits at small angles; below kSmall
// their series are exact to rounding after four terms.
struct TurnFactors {
  double along = 1.0;
  double across = 0.5;
};
TurnFactors factors_of(double angle2) {
  constexpr double kSmall = 0.01;
  if (angle2 < kSmall * kSmall) {
    const double x = angle2;
    return {.along = 1.0 - x * (1.0 / 6.0) * (1.0 - x * (1.0 / 20.0) * (1.0 - x * (1.0 / 42.0))),
            .across = 0.5 - x * (1.0 / 24.0) * (1.0 - x * (1.0 / 30.0) * (1.0 - x * (1.0 / 56.0)))};
  }
  const double angle = std::sqrt(angle2);
  const double half = sine_cosine(0.5 * angle).sine / (0.5 * angle);
  return {.along = sine_cosine(angle).sine / angle, .across = 0.5 * half * half};
}

// Returns a vector turned back by a rotation.
Vec3 turned_back(const Vec3& turn, const Vec3& v) {
  const double angle2 = turn.squaredNorm();
  const TurnFactors factors = factors_of(angle2);
  return (1.0 - factors.across * angle2) * v - factors.along * turn.cross(v) +
         factors.across * turn.dot(v) * turn;
}

// Returns the orthonormal matrix next to one that is orthonormal to rounding: one step of Newton's.
Mat3 orthonormal(const Mat3& m) {
  const Mat3 square = m.transpose() * m;
  return 0.5 * m * (3.0 * Mat3::Identity() - square);
}

}  // namespace

RigidBody::RigidBody(const BodyMass& mass, const RigidPose& X_WO, const Vec3& velocity_W,
                     const Vec3& angular_velocity_O)
    : mass_(mass), inverse_inertia_C_(mass.inertia_C.inverse()) {
  set_motion({.center_W = X_WO.point(mass.center_O),
              .velocity_W = velocity_W,
              .rotation_WO = X_WO.rotation,
              .angular_momentum_W = X_WO.direction(mass.inertia_C * angular_velocity_O)});
}

void RigidBody::set_motion(const BodyMotion& motion) {
  motion_ = motion;
  follow_rotation();
}

void RigidBody::take_place(const RigidBody& moved) {
  motion_.center_W = moved.motion_.center_W;
  motion_.rotation_WO = moved.motion_.rotation_WO;
  inverse_inertia_W_ = moved.inverse_inertia_W_;
  angular_velocity_W_ = inverse_inertia_W_ * motion_.angular_momentum_W;
}

void RigidBody::follow_rotation() {
  const Mat3& R = motion_.rotation_WO;
  inverse_inertia_W_ = R * inverse_inertia_C_ * R.transpose();
  angular_velocity_W_ = inverse_inertia_W_ * motion_.angular_momentum_W;
}

RigidPose RigidBody::pose() const {
  return {.rotation = motion_.rotation_WO,
          .translation = motion_.center_W - motion_.rotation_WO * mass_.center_O};
}

Twist RigidBody::twist() const {
  return {.linear_W = velocity_at(pose().translation), .angular_W = angular_velocity_W_};
}

void RigidBody::push(const Vec3& impulse_W, const Vec3& torque_impulse_W) {
  motion_.velocity_W += impulse_W / mass_.mass_kg;
  motion_.angular_momentum_W += torque_impulse_W;
  angular_velocity_W_ = inverse_inertia_W_ * motion_.angular_momentum_W;
}

void RigidBody::accelerate(const Vec3& gravity_W, double step_s) {
  motion_.velocity_W += step_s * gravity_W;
  motion_.velocity_W /= 1.0 + step_s * mass_.linear_damping_per_s;
  motion_.angular_momentum_W /= 1.0 + step_s * mass_.angular_damping_per_s;
  if (const double speed = motion_.velocity_W.norm(); speed > kFastestBody_m_per_s) {
    motion_.velocity_W *= kFastestBody_m_per_s / speed;
  }
  angular_velocity_W_ = inverse_inertia_W_ * motion_.angular_momentum_W;
  const double turn = step_s * angular_velocity_W_.norm();
  if (turn > 1.0) {
    motion_.angular_momentum_W /= turn;
    angular_velocity_W_ /= turn;
  }
}

void RigidBody::move(double step_s) {
  motion_.center_W += step_s * motion_.velocity_W;
  motion_.rotation_WO =
      rotate_freely(inverse_inertia_C_, motion_.rotation_WO, motion_.angular_momentum_W, step_s);
  follow_rotation();
}

double RigidBody::kinetic_energy_J() const {
  return 0.5 * (mass_.mass_kg * motion_.velocity_W.squaredNorm() +
                motion_.angular_momentum_W.dot(angular_velocity_W_));
}

Mat3 rotate_freely(const Mat3& inverse_inertia_C, const Mat3& rotation_WO, const Vec3& momentum_W,
                   double step_s) {
  const Vec3 before = rotation_WO.transpose() * momentum_W;
  Vec3 turn = step_s * (inverse_inertia_C * before);
  turn = step_s * (inverse_inertia_C * (before - 0.5 * turn.cross(before)));
  for (int i = 0; i < kMidpointSteps; ++i) {
    const Vec3 after = turned_back(turn, before);
    const Vec3 next = 0.5 * step_s * (inverse_inertia_C * (before + after));
    const bool settled = (next - turn).squaredNorm() <= 1e-32 * next.squaredNorm();
    turn = next;
    if (settled) {
      break;
    }
  }
  return orthonormal(rotation_WO * rotation_by(turn));
}

Mat3 rotation_by(const Vec3& turn) {
  const double angle2 = turn.squaredNorm();
  const TurnFactors factors = factors_of(angle2);
  // The square of the cross product's matrix is w w' - w^2.
  return (1.0 - factors.across * angle2) * Mat3::Identity() + factors.along * cross_matrix(turn) +
         factors.across * turn * turn.transpose();
}

}  // namespace tactus::rendering
