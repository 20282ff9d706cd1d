#include "host_tools/simulation/plant_mechanism.h"

#include <cmath>
#include <numbers>

#include "host_tools/simulation/linkages.h"

namespace tactus::host {
namespace {

// Lengths of the Falcon, m, named by the letters of its published geometry.
constexpr double kA = 0.060;     // upper arm
constexpr double kB = 0.1025;    // parallelogram
constexpr double kC = 0.01443;   // shoulder to the platform's joint circle
constexpr double kDE = 0.0225;   // d + e, the parallelogram's end pieces
constexpr double kF = -0.025;    // sideways offset of the leg
constexpr double kR = 0.0400;    // base
constexpr double kS = -0.02309;  // base, sideways

// The direction of a leg about z.
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

// Solves one leg in its own frame, P = Rz(azimuth)^T p - (r, s, 0). The angle theta3 follows from
// P_y. With q, the parallelogram's length as seen in the leg's plane, the condition
//   |P + (c, 0, 0) - a (cos theta1, 0, sin theta1)| = q
// is a quadratic in tan(theta1 / 2).
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
  // The root with the elbow outward, in the form that does not subtract nearly equal numbers.
  tan_half = l0 / (half_l1 + root);

  const auto [cos1, sin1] = turn_of(tan_half);
  const double cos2 = (px + kC - kA * cos1) / q;
  const double sin2 = guarded_root(1.0 - cos2 * cos2, reachable);
  const double gain = -1.0 / (kA * sin3 * (sin1 * cos2 - cos1 * sin2));
  row = gain * Vec3(leg.cos * cos2 * sin3 - leg.sin * cos3, leg.sin * cos2 * sin3 + leg.cos * cos3,
                    sin2 * sin3);
}

// Returns the unit vector from the base's axis to the leg.
Vec3 outward(const Azimuth& leg) {
  return {leg.cos, leg.sin, 0.0};
}

// Returns the sum of the three elbows' positions, m.
Vec3 delta_elbow_sum(const MechanismPose& pose) {
  Vec3 sum_B = Vec3::Zero();
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    const Turn arm = turn_of(pose.coordinate[i]);
    sum_B += (kR + kA * arm.cos) * outward(kLegs[i]) + kS * Vec3(-kLegs[i].sin, kLegs[i].cos, 0.0) +
             kA * arm.sin * Vec3::UnitZ();
  }
  return sum_B;
}

// The weight's moment about each shoulder, turned into a force at the handle by the leg's row.
Vec3 delta_elbow_pull(const MechanismPose& pose, const Vec3& gravity_B) {
  Vec3 pull_B = Vec3::Zero();
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    const Turn arm = turn_of(pose.coordinate[i]);
    const double moment =
        kA * (arm.cos * gravity_B.z() - arm.sin * outward(kLegs[i]).dot(gravity_B));
    pull_B += moment * pose.rows[i];
  }
  return pull_B;
}

// Returns the lengths of a serial arm.
const ArmLengths& arm_lengths(MechanismKind kind) {
  return kind == MechanismKind::woodenhaptics ? kWoodenLengths : kPhantomLengths;
}

}  // namespace

std::size_t joints_of(MechanismKind kind) {
  switch (kind) {
    case MechanismKind::hapkit:
      return 1;
    case MechanismKind::haply_pantograph:
      return 2;
    default:
      return 3;
  }
}

void solve_mechanism(MechanismKind kind, const Vec3& p_B, MechanismPose& pose) {
  pose.reachable = true;
  switch (kind) {
    case MechanismKind::cartesian:
      pose.coordinate = {p_B.x(), p_B.y(), p_B.z()};
      break;
    case MechanismKind::falcon_delta:
      for (std::size_t i = 0; i < kPlantJoints; ++i) {
        solve_leg(p_B, kLegs[i], pose.rows[i], pose.coordinate[i], pose.reachable);
      }
      break;
    case MechanismKind::hapkit:
      solve_paddle(p_B, pose);
      break;
    case MechanismKind::haply_pantograph:
      solve_pantograph(p_B, pose);
      break;
    case MechanismKind::phantom_premium:
    case MechanismKind::woodenhaptics:
      solve_serial_arm(arm_lengths(kind), p_B, pose);
      break;
  }
}

double joint_position(MechanismKind kind, std::size_t joint, double coordinate) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  if (kind == MechanismKind::cartesian) {
    return coordinate;
  }
  if (joint >= joints_of(kind)) {
    return 0.0;
  }
  const double angle = 2.0 * std::atan(coordinate);
  switch (kind) {
    case MechanismKind::haply_pantograph:
      return kQuarter + angle;
    case MechanismKind::phantom_premium:
    case MechanismKind::woodenhaptics:
      return joint == 2 ? kQuarter + angle : angle;
    default:
      return angle;
  }
}

Vec3 on_manifold(MechanismKind kind, const Vec3& p_B) {
  if (kind == MechanismKind::haply_pantograph) {
    return {p_B.x(), 0.0, p_B.z()};
  }
  if (kind == MechanismKind::hapkit) {
    const double radius = std::sqrt(p_B.x() * p_B.x() + p_B.y() * p_B.y());
    return radius > 0.0 ? Vec3(Vec3(p_B.x(), p_B.y(), 0.0) * (kPaddleRadius_m / radius))
                        : Vec3(0.0, kPaddleRadius_m, 0.0);
  }
  return p_B;
}

Vec3 along_manifold(MechanismKind kind, const Vec3& p_B, const Vec3& v_B) {
  if (kind == MechanismKind::haply_pantograph) {
    return {v_B.x(), 0.0, v_B.z()};
  }
  if (kind == MechanismKind::hapkit) {
    const Vec3 along = Vec3(p_B.y(), -p_B.x(), 0.0) / kPaddleRadius_m;
    return along.dot(v_B) * along;
  }
  return v_B;
}

Vec3 elbow_sum(MechanismKind kind, const MechanismPose& pose) {
  switch (kind) {
    case MechanismKind::falcon_delta:
      return delta_elbow_sum(pose);
    case MechanismKind::haply_pantograph:
      return pantograph_elbow_sum(pose);
    case MechanismKind::phantom_premium:
    case MechanismKind::woodenhaptics:
      return serial_arm_elbow(arm_lengths(kind), pose);
    default:
      return Vec3::Zero();
  }
}

Vec3 elbow_pull(MechanismKind kind, const MechanismPose& pose, const Vec3& gravity_B) {
  switch (kind) {
    case MechanismKind::falcon_delta:
      return delta_elbow_pull(pose, gravity_B);
    case MechanismKind::haply_pantograph:
      return pantograph_elbow_pull(pose, gravity_B);
    case MechanismKind::phantom_premium:
    case MechanismKind::woodenhaptics:
      return serial_arm_elbow_pull(arm_lengths(kind), pose, gravity_B);
    default:
      return Vec3::Zero();
  }
}

}  // namespace tactus::host
