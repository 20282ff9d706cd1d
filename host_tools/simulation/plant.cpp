#include "host_tools/simulation/plant.h"

#include <algorithm>

namespace tactus::host {
namespace {

// Returns how far p lies outside of the box, signed and axis by axis, m.
Vec3 beyond(const Vec3& p_B, const Vec3& lower_B, const Vec3& upper_B) {
  return p_B - p_B.cwiseMax(lower_B).cwiseMin(upper_B);
}

}  // namespace

Plant::Plant(const PlantParameters& parameters)
    : parameters_(parameters),
      joints_{JointFriction(parameters.joint_friction), JointFriction(parameters.joint_friction),
              JointFriction(parameters.joint_friction)} {
  place(Vec3::Zero());
}

void Plant::place(const Vec3& p_B) {
  p_B_ = on_manifold(parameters_.mechanism, p_B);
  v_B_.setZero();
  for (JointFriction& joint : joints_) {
    joint.release();
  }
  solve_mechanism(parameters_.mechanism, p_B_, pose_);
  ledger_ = {};
}

Vec3 Plant::stop_force() const {
  const Vec3 depth_B = beyond(p_B_, parameters_.stop_lower_B, parameters_.stop_upper_B);
  Vec3 force_B = -parameters_.stop_stiffness_N_per_m * depth_B;
  for (int axis = 0; axis < 3; ++axis) {
    if (depth_B[axis] != 0.0) {
      force_B[axis] -= parameters_.stop_damping_Ns_per_m * v_B_[axis];
    }
  }
  return force_B;
}

// An elbow's weight acts at the handle through the rows, by virtual work.
Vec3 Plant::weight_force() const {
  Vec3 force_B = parameters_.handle_kg * parameters_.gravity_B;
  if (parameters_.elbow_kg != 0.0) {
    force_B +=
        parameters_.elbow_kg * elbow_pull(parameters_.mechanism, pose_, parameters_.gravity_B);
  }
  return force_B;
}

void Plant::step(const JointEfforts& effort, const Grip& grip, double dt_s) {
  Vec3 motors_B = Vec3::Zero();
  Vec3 friction_and_stops_B = stop_force();
  const Vec3 weight_B = weight_force();
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    const Vec3& row = pose_.rows[i];
    motors_B += effort[i] * row;
    friction_and_stops_B -= joints_[i].advance(row.dot(v_B_), dt_s) * row;
  }

  // Implicit midpoint rule, solved for the mean velocity u = (v + v')/2 of the step, with p' = p +
  // u dt:
  //   2 m (u - v)/dt = F + k (w - p - u dt/2) + c (dw/dt - u) - b u
  // It is linear in u, and k, c and b are alike in all directions, so u is a division and no matrix
  // solve.
  const double mass = parameters_.moving_mass_kg + grip.mass_kg;
  const double inertia = 2.0 * mass / dt_s;
  const double viscous = parameters_.viscous_Ns_per_m;
  const double divisor =
      inertia + 0.5 * dt_s * grip.stiffness_N_per_m + grip.damping_Ns_per_m + viscous;
  const Vec3 mean_v_B = along_manifold(
      parameters_.mechanism, p_B_,
      (inertia * v_B_ + motors_B + friction_and_stops_B + weight_B +
       grip.stiffness_N_per_m * (grip.wish_p_B - p_B_) + grip.damping_Ns_per_m * grip.wish_v_B) /
          divisor);
  const Vec3 moved_B = dt_s * mean_v_B;
  const Vec3 hand_B = grip.stiffness_N_per_m * (grip.wish_p_B - p_B_ - 0.5 * moved_B) +
                      grip.damping_Ns_per_m * (grip.wish_v_B - mean_v_B);
  ledger_.motors_J += motors_B.dot(moved_B);
  ledger_.hand_J += hand_B.dot(moved_B);
  ledger_.viscous_J -= viscous * mean_v_B.dot(moved_B);
  ledger_.friction_and_stops_J += friction_and_stops_B.dot(moved_B);
  ledger_.weight_J += weight_B.dot(moved_B);
  move(mean_v_B, dt_s);
}

// v' = 2 u - v. On the paddle's arc the velocity then turns with the arc: its direction is tangent
// at the new place, its size is what the forces made of it, so that turning costs no energy.
void Plant::move(const Vec3& mean_v_B, double dt_s) {
  const PlantMechanism& mechanism = parameters_.mechanism;
  const Vec3 ahead_v_B = 2.0 * mean_v_B - v_B_;
  p_B_ = on_manifold(mechanism, p_B_ + dt_s * mean_v_B);
  v_B_ = along_manifold(mechanism, p_B_, ahead_v_B);
  const double speed = v_B_.norm();
  if (std::holds_alternative<PaddleLengths>(mechanism) && speed > 0.0) {
    v_B_ *= ahead_v_B.norm() / speed;
  }
  solve_mechanism(mechanism, p_B_, pose_);
}

double Plant::stored_energy_J() const {
  const Vec3 depth_B = beyond(p_B_, parameters_.stop_lower_B, parameters_.stop_upper_B);
  double energy_J = 0.5 * parameters_.stop_stiffness_N_per_m * depth_B.squaredNorm();
  for (const JointFriction& joint : joints_) {
    energy_J += joint.stored_energy_J();
  }
  return energy_J;
}

double Plant::potential_J() const {
  const Vec3 moment_B =
      parameters_.handle_kg * p_B_ + parameters_.elbow_kg * elbow_sum(parameters_.mechanism, pose_);
  return -parameters_.gravity_B.dot(moment_B);
}

}  // namespace tactus::host
