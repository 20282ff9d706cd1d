// The closed-form geometry of the paddle, the pantograph and the serial arms for
// plant_mechanism.cpp, one function for each question that plant_mechanism.h asks. All points are
// in the base frame B, m.
//
// A joint's coordinate is tan(half its angle). The angles are counted as follows:
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

// The distance of the Hapkit's handle from its axis.
inline constexpr double kPaddleRadius_m = 0.065659;

// Each of these solves the pose of its mechanism for a handle at p_B: coordinates, rows and whether
// the links reach there.
void solve_paddle(const Vec3& p_B, MechanismPose& pose);

void solve_pantograph(const Vec3& p_B, MechanismPose& pose);
// Returns the sum of the two elbows' positions, m.
Vec3 pantograph_elbow_sum(const MechanismPose& pose);
// Returns the force on the handle, N, from gravity (m/s^2) on 1 kg at each elbow.
Vec3 pantograph_elbow_pull(const MechanismPose& pose, const Vec3& gravity_B);

// The lengths of a serial arm.
struct ArmLengths {
  // The distance from the shoulder to the elbow.
  double upper_m = 0.0;
  // The distance from the elbow to the handle.
  double forearm_m = 0.0;
  // The height of the shoulder above the base frame's origin.
  double shoulder_m = 0.0;
};
inline constexpr ArmLengths kPhantomLengths{.upper_m = 0.209550, .forearm_m = 0.169545};
inline constexpr ArmLengths kWoodenLengths{
    .upper_m = 0.205, .forearm_m = 0.245, .shoulder_m = 0.080};

void solve_serial_arm(const ArmLengths& lengths, const Vec3& p_B, MechanismPose& pose);
// Returns the position of the elbow, m.
Vec3 serial_arm_elbow(const ArmLengths& lengths, const MechanismPose& pose);
// Returns the force on the handle, N, from gravity (m/s^2) on 1 kg at the elbow.
Vec3 serial_arm_elbow_pull(const ArmLengths& lengths, const MechanismPose& pose,
                           const Vec3& gravity_B);

}  // namespace tactus::host
