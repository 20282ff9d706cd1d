#include "rendering/bodies/solver_body.h"

#include <cmath>

namespace tactus::rendering {
namespace {

// Returns the inverse of a symmetric positive definite matrix by Cholesky's factors. Eigen's own
// may ask for heap.
Mat6 inverse_of(const Mat6& matrix) {
  Mat6 lower = Mat6::Zero();
  Mat6 inverse = Mat6::Zero();
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      double left = matrix(i, j);
      for (Eigen::Index k = 0; k < j; ++k) {
        left -= lower(i, k) * lower(j, k);
      }
      lower(i, j) = i == j ? std::sqrt(left) : left / lower(j, j);
    }
    for (Eigen::Index j = 0; j <= i; ++j) {
      double left = i == j ? 1.0 : 0.0;
      for (Eigen::Index k = j; k < i; ++k) {
        left -= lower(i, k) * inverse(k, j);
      }
      inverse(i, j) = left / lower(i, i);
    }
  }
  return inverse.transpose().lazyProduct(inverse);
}

}  // namespace

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
  velocity_before_ = velocity_;
  has_springs_ = false;
}

void SolverBody::set_springs(const Mat6& inertia, double stiff_share) {
  Mat6 apparent = inertia;
  apparent.topLeftCorner<3, 3>() += mass_kg_ * Mat3::Identity();
  apparent.bottomRightCorner<3, 3>() += inertia_W_;
  apparent_inverse_ = inverse_of(apparent);
  has_springs_ = true;
  stiff_share_ = stiff_share;
}

Vec6 SolverBody::impulse_since_begin() const {
  const Vec6 change = velocity_ - velocity_before_;
  Vec6 impulse;
  impulse.head<3>() = mass_kg_ * change.head<3>();
  impulse.tail<3>() = inertia_W_ * change.tail<3>();
  return impulse;
}

Vec6 SolverBody::answer_to(const Vec6& wrench) const {
  if (has_springs_) {
    return apparent_inverse_ * wrench;
  }
  Vec6 answer;
  answer.head<3>() = inverse_mass_ * wrench.head<3>();
  answer.tail<3>() = inverse_inertia_W_ * wrench.tail<3>();
  return answer;
}

}  // namespace tactus::rendering
