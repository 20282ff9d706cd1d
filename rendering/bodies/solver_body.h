// A body while its tick is solved: its velocities, and how impulses change them.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "rendering/bodies/rigid_body.h"
#include "rendering/geometry/pair.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// A velocity of a body, or an impulse with its torque: the linear part first, then the angular one
// about the centre of mass; world frame.
using Vec6 = Eigen::Matrix<double, 6, 1>;
// An inertia of a body, or its inverse, in the same order.
using Mat6 = Eigen::Matrix<double, 6, 6>;

// Returns the vector with these parts.
inline Vec6 spatial(const Vec3& linear, const Vec3& angular) {
  Vec6 vector;
  vector << linear, angular;
  return vector;
}

// Returns an impulse at `arm_W` from the centre of mass with its torque.
inline Vec6 wrench_of(const Vec3& impulse_W, const Vec3& arm_W) {
  return spatial(impulse_W, arm_W.cross(impulse_W));
}

// Such a vector in registers, while it is changed many times.
class PairedVec6 {
 public:
  explicit PairedVec6(const Vec6& vector)
      : first_(pair_at(vector.data())),
        second_(pair_at(vector.data() + 2)),
        third_(pair_at(vector.data() + 4)) {}
  // Takes two vectors of three numbers.
  PairedVec6(const double* first, const double* last)
      : first_(pair_at(first)), second_(Pair{first[2], last[0]}), third_(pair_at(last + 1)) {}

  // Returns the product with another vector.
  [[nodiscard]] double dot(const Vec6& other) const {
    const Pair sum = products(other);
    return sum[0] + sum[1];
  }
  // Returns the products with two other vectors.
  [[nodiscard]] Pair dots(const Vec6& one, const Vec6& other) const {
    const Pair of_one = products(one);
    const Pair of_other = products(other);
    return Pair{of_one[0], of_other[0]} + Pair{of_one[1], of_other[1]};
  }

  // Adds a multiple of another vector, or of two.
  void gain(double factor, const Vec6& other) {
    const double* const p = other.data();
    first_ += both(factor) * pair_at(p);
    second_ += both(factor) * pair_at(p + 2);
    third_ += both(factor) * pair_at(p + 4);
  }

  void gain(double factor_x, const Vec6& x, double factor_y, const Vec6& y) {
    const double* const p = x.data();
    const double* const q = y.data();
    first_ += both(factor_x) * pair_at(p) + both(factor_y) * pair_at(q);
    second_ += both(factor_x) * pair_at(p + 2) + both(factor_y) * pair_at(q + 2);
    third_ += both(factor_x) * pair_at(p + 4) + both(factor_y) * pair_at(q + 4);
  }

  // Return the first and the last three numbers, and all.
  [[nodiscard]] Vec3 head() const { return {first_[0], first_[1], second_[0]}; }
  [[nodiscard]] Vec3 tail() const { return {second_[1], third_[0], third_[1]}; }
  [[nodiscard]] Vec6 value() const {
    Vec6 vector;
    vector << first_[0], first_[1], second_[0], second_[1], third_[0], third_[1];
    return vector;
  }

 private:
  [[nodiscard]] Pair products(const Vec6& other) const {
    const double* const p = other.data();
    return pair_at(p) * first_ + pair_at(p + 2) * second_ + pair_at(p + 4) * third_;
  }

  Pair first_;
  Pair second_;
  Pair third_;
};

// Returns the product of two such vectors.
inline double dot(const Vec6& x, const Vec6& y) {
  return PairedVec6(y).dot(x);
}

// The velocities of a body in a sub-step. What nothing can push, an obstacle, has no mobility and
// keeps its velocities. A body that springs hold answers an impulse as if it had a larger inertia
// (finger_grip.h).
class SolverBody {
 public:
  // Take a body, or an obstacle that moves with the twist at its origin.
  void take(const RigidBody& body);
  void take_obstacle(const Vec3& origin_W, const Twist& twist);

  // Begins a sub-step with the body's velocities, without springs.
  void begin(const RigidBody& body);

  // Sets what springs add to the inertia: a symmetric matrix that is not negative; and the share of
  // it that their stiffness adds. Their damping adds the rest.
  void set_springs(const Mat6& inertia, double stiff_share);

  // Returns the point from which arms lead: the centre of mass, or an obstacle's origin.
  [[nodiscard]] const Vec3& center_W() const { return center_W_; }
  // Returns the velocity of the point at `arm_W`, m/s.
  [[nodiscard]] Vec3 velocity_at(const Vec3& arm_W) const {
    return velocity_.head<3>() + velocity_.tail<3>().cross(arm_W);
  }
  [[nodiscard]] const Vec6& velocity() const { return velocity_; }

  // Changes the velocities by an impulse with its torque, or by a multiple of an answer_to() one.
  void accelerate(const Vec6& wrench) { velocity_ += answer_to(wrench); }
  void gain(double factor, const Vec6& answer) {
    PairedVec6 velocity(velocity_);
    velocity.gain(factor, answer);
    velocity_ = velocity.value();
  }
  // Applies a multiple of an impulse to a body that no springs hold, and sets the angular velocity.
  void push_to(double factor, const Vec3& impulse_W, const Vec3& angular_W) {
    const double change = factor * inverse_mass_;
    velocity_[0] += change * impulse_W.x();
    velocity_[1] += change * impulse_W.y();
    velocity_[2] += change * impulse_W.z();
    velocity_[3] = angular_W.x();
    velocity_[4] = angular_W.y();
    velocity_[5] = angular_W.z();
  }

  // Returns the impulse, with its torque, that has changed the velocities since the beginning of
  // the sub-step. For a body that no springs hold.
  [[nodiscard]] Vec6 impulse_since_begin() const;

  // Returns true if the body answers an impulse: an obstacle does not.
  [[nodiscard]] bool can_move() const { return inverse_mass_ > 0.0; }
  // Return the inverses of the mass and of the inertia about the centre, world frame; 0 of an
  // obstacle.
  [[nodiscard]] double inverse_mass() const { return inverse_mass_; }
  [[nodiscard]] const Mat3& inverse_inertia_W() const { return inverse_inertia_W_; }
  // Returns true if springs hold the body in this sub-step.
  [[nodiscard]] bool has_springs() const { return has_springs_; }
  // Returns the share of the springs' inertia that their stiffness adds; 0 without springs.
  [[nodiscard]] double stiff_share() const { return has_springs_ ? stiff_share_ : 0.0; }
  // Returns the change of the velocities by an impulse with its torque.
  [[nodiscard]] Vec6 answer_to(const Vec6& wrench) const;

 private:
  Vec3 center_W_ = Vec3::Zero();
  double mass_kg_ = 0.0;
  double inverse_mass_ = 0.0;
  Mat3 inertia_W_ = Mat3::Zero();
  Mat3 inverse_inertia_W_ = Mat3::Zero();
  // True if springs hold the body; then the share of their inertia that their stiffness adds, and
  // the inverse of the inertia with them.
  bool has_springs_ = false;
  double stiff_share_ = 0.0;
  Mat6 apparent_inverse_ = Mat6::Zero();
  Vec6 velocity_ = Vec6::Zero();
  // The velocities at the beginning of the sub-step.
  Vec6 velocity_before_ = Vec6::Zero();
};

}  // namespace tactus::rendering
