// The geometry of the simulated devices: how motions of the handle turn the joints. It is derived
// from the published closed forms, position to joints, and on purpose shares nothing with the
// controller's kinematics (firmware/kinematics), so that an error in either shows in the whole-loop
// tests.
#pragma once

#include <array>
#include <cstddef>

#include "host_tools/simulation/plant_lengths.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

// Returns the number of joints that the mechanism has; joints beyond it read 0 and move nothing.
std::size_t joints_of(const PlantMechanism& mechanism);

// Row i is the rate of joint i (rad/s or m/s) for each m/s of the handle: joint rates = rows . v.
// By virtual work, the handle feels the force sum_i row_i effort_i.
using JointRateRows = std::array<Vec3, kPlantJoints>;

// The joints at one position of the handle.
struct MechanismPose {
  JointRateRows rows{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  // tan(half the joint's angle), counted from the middle of its travel; for a
  // Cartesian device the position itself, m. joint_position() turns it into rad or m.
  std::array<double, kPlantJoints> coordinate{};
  // False where the links do not reach; the rows are finite even then.
  bool reachable = true;
};

// Computes the pose for a handle at `p_B`, m. It uses no transcendental functions, since it runs in
// every sub-step and must give the same bits on every processor.
void solve_mechanism(const PlantMechanism& mechanism, const Vec3& p_B, MechanismPose& pose);

// Returns the position of joint 0, 1 or 2 that belongs to a coordinate, rad, or m if it slides.
double joint_position(const PlantMechanism& mechanism, std::size_t joint, double coordinate);

// With fewer than three joints the handle moves only on an arc or a plane, the manifold. Returns
// the point of it that is nearest to `p_B`, m.
Vec3 on_manifold(const PlantMechanism& mechanism, const Vec3& p_B);
// Returns the part of a velocity or force at `p_B` that is tangent to the manifold.
Vec3 along_manifold(const PlantMechanism& mechanism, const Vec3& p_B, const Vec3& v_B);

// The elbow is the joint between the link at the base and the link at the handle; a paddle has
// none, and the carriages of a Cartesian device count in its place, each with its mass
// (plant_lengths.h). Returns the sum of the elbows' positions, m.
Vec3 elbow_sum(const PlantMechanism& mechanism, const MechanismPose& pose);
// Returns the force on the handle, N, from gravity (m/s^2) on a mass of 1 kg at every elbow.
Vec3 elbow_pull(const PlantMechanism& mechanism, const MechanismPose& pose, const Vec3& gravity_B);

}  // namespace tactus::host
