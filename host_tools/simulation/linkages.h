// The closed-form geometry of the delta, the paddle, the pantograph and the serial arms for
// plant_mechanism.cpp, one function for each question that plant_mechanism.h asks. All points are
// in the base frame B, m.
//
// A joint's coordinate is tan(half its angle). The angles are counted as follows:
//   delta        each arm from the base plane toward the user (+z)
//   paddle       from straight up
//   pantograph   both cranks from straight toward the user (+z)
//   serial arm   azimuth from straight toward the user (+z), upper arm and forearm from level
#pragma once

#include "host_tools/simulation/plant_mechanism.h"

namespace tactus::host {

// Returns the square root of `square`, or of a small floor if `square` is below it; `reachable`
// then becomes false. A mechanism at the edge of its reach has square roots of zero in
// denominators, and the rows must stay finite there.
double guarded_root(double square, bool& reachable);

// The cosine and sine of an angle.
struct Turn {
  double cos = 1.0;
  double sin = 0.0;
};
// Returns cosine and sine of the angle whose half has this tangent.
Turn turn_of(double tan_half);

// Each of these solves the pose of its mechanism for a handle at p_B: coordinates, rows and whether
// the links reach there.
void solve_delta(const DeltaLengths& lengths, const Vec3& p_B, MechanismPose& pose);
// Returns the sum of the three elbows' positions, m.
Vec3 delta_elbow_sum(const DeltaLengths& lengths, const MechanismPose& pose);
// Returns the force on the handle, N, from gravity (m/s^2) on 1 kg at each elbow.
Vec3 delta_elbow_pull(const DeltaLengths& lengths, const MechanismPose& pose,
                      const Vec3& gravity_B);

void solve_paddle(const PaddleLengths& lengths, const Vec3& p_B, MechanismPose& pose);

void solve_pantograph(const PantographLengths& lengths, const Vec3& p_B, MechanismPose& pose);
// Returns the sum of the two elbows' positions, m.
Vec3 pantograph_elbow_sum(const PantographLengths& lengths, const MechanismPose& pose);
// Returns the force on the handle, N, from gravity (m/s^2) on 1 kg at each elbow.
Vec3 pantograph_elbow_pull(const PantographLengths& lengths, const MechanismPose& pose,
                           const Vec3& gravity_B);

void solve_serial_arm(const ArmLengths& lengths, const Vec3& p_B, MechanismPose& pose);
// Returns the position of the elbow, m.
Vec3 serial_arm_elbow(const ArmLengths& lengths, const MechanismPose& pose);
// Returns the force on the handle, N, from gravity (m/s^2) on 1 kg at the elbow.
Vec3 serial_arm_elbow_pull(const ArmLengths& lengths, const MechanismPose& pose,
                           const Vec3& gravity_B);

}  // namespace tactus::host
