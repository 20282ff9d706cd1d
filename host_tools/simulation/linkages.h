// The plane linkages and the serial arms behind plant_mechanism.h, one function for each
// question there.
//
// Coordinates are tan(half an angle): the paddle's from straight up, a pantograph's crank from
// straight toward the user, the arm's azimuth from straight toward the user, upper arm and forearm
// from level.
#pragma once

#include "host_tools/simulation/plant_mechanism.h"

namespace tactus::host {

// The square root, or that of a floor: a mechanism at the edge of its reach loses its square roots,
// and the rows must stay finite there.
double guarded_root(double square, bool& reachable);

struct Turn {
  double cos = 1.0;
  double sin = 0.0;
};
Turn turn_of(double tan_half);

inline constexpr double kPaddleRadius_m = 0.065659;

void solve_paddle(const Vec3& p_B, MechanismPose& pose);

void solve_pantograph(const Vec3& p_B, MechanismPose& pose);
Vec3 pantograph_elbow_sum(const MechanismPose& pose);
Vec3 pantograph_elbow_pull(const MechanismPose& pose, const Vec3& gravity_B);

struct ArmLengths {
  double upper_m = 0.0;
  double forearm_m = 0.0;
  double shoulder_m = 0.0;  // height
};
inline constexpr ArmLengths kPhantomLengths{.upper_m = 0.209550, .forearm_m = 0.169545};
inline constexpr ArmLengths kWoodenLengths{
    .upper_m = 0.205, .forearm_m = 0.245, .shoulder_m = 0.080};

void solve_serial_arm(const ArmLengths& lengths, const Vec3& p_B, MechanismPose& pose);
Vec3 serial_arm_elbow(const ArmLengths& lengths, const MechanismPose& pose);
Vec3 serial_arm_elbow_pull(const ArmLengths& lengths, const MechanismPose& pose,
                           const Vec3& gravity_B);

}  // namespace tactus::host
