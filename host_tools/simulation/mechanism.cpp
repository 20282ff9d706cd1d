#include "host_tools/simulation/mechanism.h"

#include <algorithm>
#include <cmath>

namespace tactus::host {
namespace {

// Lengths of the Falcon in m, in the letters of its published geometry.
constexpr double kA = 0.060;     // upper arm
constexpr double kB = 0.1025;    // parallelogram
constexpr double kC = 0.01443;   // shoulder to the platform's joint circle
constexpr double kDE = 0.0225;   // d + e, the parallelogram's end pieces
constexpr double kF = -0.025;    // sideways offset of the leg
constexpr double kR = 0.0400;    // base
constexpr double kS = -0.02309;  // base, sideways

struct Azimuth {
  double cos;
  double sin;
};
// 105, -15 and -135 degrees.
constexpr std::array<Azimuth, kPlantJoints> kLegs{{
    {.cos = -0.25881904510252074, .sin = 0.9659258262890683},
    {.cos = 0.9659258262890683, .sin = -0.25881904510252074},
    {.cos = -0.7071067811865476, .sin = -0.7071067811865476},
}};

// A leg at the edge of its reach loses its square roots; this floor keeps the rows finite there.
constexpr double kSmallestSquare = 1e-6;

double guarded_root(double square, bool& reachable) {
  reachable = reachable && square >= kSmallestSquare;
  return std::sqrt(std::max(square, kSmallestSquare));
}

// One leg in its own plane: P = Rz(azimuth)^T p - (r, s, 0). With theta3 from P_y and q the
// parallelogram's length seen in the plane, |P + (c, 0, 0) - a (cos theta1, 0, sin theta1)| = q is
// a quadratic in tan(theta1 / 2).
void solve_leg(const Vec3& p_B, const Azimuth& leg, Vec3& row, double& tan_half, bool& reachable) {
  const double px = leg.cos * p_B.x() + leg.sin * p_B.y() - kR;
  const double py = -leg.sin * p_B.x() + leg.cos * p_B.y() - kS;
  const double pz = p_B.z();

  const double cos3 = (py + kF) / kB;
  const double sin3 = guarded_root(1.0 - cos3 * cos3, reachable);
  const double q = kB * sin3 + kDE;

  const double inner = px + kC - kA;
  const double outer = px + kC + kA;
  const double l0 = pz * pz + inner * inner - q * q;
  const double l2 = pz * pz + outer * outer - q * q;
  const double half_l1 = 2.0 * kA * pz;
  const double scale = kA * kA * kA * kA;
  const double root =
      std::sqrt(scale) * guarded_root((half_l1 * half_l1 - l0 * l2) / scale, reachable);
  tan_half = l0 / (half_l1 + root);  // the elbow-out root, without its cancellation

  const double norm = 1.0 + tan_half * tan_half;
  const double cos1 = (1.0 - tan_half * tan_half) / norm;
  const double sin1 = 2.0 * tan_half / norm;
  const double cos2 = (px + kC - kA * cos1) / q;
  const double sin2 = guarded_root(1.0 - cos2 * cos2, reachable);
  const double gain = -1.0 / (kA * sin3 * (sin1 * cos2 - cos1 * sin2));
  row = gain * Vec3(leg.cos * cos2 * sin3 - leg.sin * cos3, leg.sin * cos2 * sin3 + leg.cos * cos3,
                    sin2 * sin3);
}

}  // namespace

void solve_mechanism(MechanismKind kind, const Vec3& p_B, MechanismPose& pose) {
  pose.reachable = true;
  if (kind == MechanismKind::cartesian) {
    pose.coordinate = {p_B.x(), p_B.y(), p_B.z()};
    return;
  }
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    solve_leg(p_B, kLegs[i], pose.rows[i], pose.coordinate[i], pose.reachable);
  }
}

double joint_position(MechanismKind kind, double coordinate) {
  return kind == MechanismKind::cartesian ? coordinate : 2.0 * std::atan(coordinate);
}

}  // namespace tactus::host
