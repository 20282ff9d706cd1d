#include "rendering/bodies/solver_body.h"

#include <Eigen/Cholesky>

namespace tactus::rendering {

void SolverBody::take(const RigidBody& body) {
  center_W_ = body.motion().center_W;
  mass_kg_ = body.mass().mass_kg;
  inverse_mass_ = 1.0 / mass_kg_;
  inertia_W_ = body.inertia_W();
  inverse_inertia_W_ = body.inverse_inertia_W();
  begin(body);
}

void SolverBody::take_obstacle(const Vec3& origin_W, const Twist& twist) {
  *this = {};
  center_W_ = origin_W;
  velocity_ << twist.linear_W, twist.angular_W;
}

void SolverBody::begin(const RigidBody& body) {
  velocity_ << body.motion().velocity_W, body.angular_velocity_W();
  pushed_.setZero();
  has_springs_ = false;
}

void SolverBody::set_springs(const Mat6& inertia) {
  Mat6 apparent = inertia;
  apparent.topLeftCorner<3, 3>() += mass_kg_ * Mat3::Identity();
  apparent.bottomRightCorner<3, 3>() += inertia_W_;
  apparent_inverse_ = apparent.llt().solve(Mat6::Identity());
  has_springs_ = true;
}

void SolverBody::push(const Vec3& impulse_W, const Vec3& arm_W) {
  const Vec6 wrench = wrench_of(impulse_W, arm_W);
  pushed_ += wrench;
  accelerate(wrench);
}

double SolverBody::mobility(const Vec3& arm_W, const Vec3& direction_W) const {
  const Vec6 wrench = wrench_of(direction_W, arm_W);
  return wrench.dot(answer_to(wrench));
}

Vec6 SolverBody::answer_to(const Vec6& wrench) const {
  if (has_springs_) {
    return apparent_inverse_ * wrench;
  }
  Vec6 answer;
  answer << inverse_mass_ * wrench.head<3>(), inverse_inertia_W_ * wrench.tail<3>();
  return answer;
}

}  // namespace tactus::rendering
