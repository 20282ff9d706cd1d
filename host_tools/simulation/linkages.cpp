#include "host_tools/simulation/linkages.h"

#include <algorithm>
#include <cmath>

namespace tactus::host {
namespace {

// The floor of guarded_root(), for squares that are scaled to 1.
constexpr double kSmallestSquare = 1e-6;

// A crank's elbow, and the elbow's derivative by the crank's angle.
struct CrankPose {
  Vec3 elbow_B;
  Vec3 slope_B;
};

// Returns the place of motor 0 or 1 on the x axis, m.
double motor_x(const PantographLengths& lengths, std::size_t side) {
  return side == 0 ? 0.0 : lengths.base_m;
}

// Returns the pose of the crank of motor 0 or 1.
CrankPose crank_of(const PantographLengths& lengths, std::size_t side, double tan_half) {
  const double crank = lengths.proximal_m;
  const Turn from_z = turn_of(tan_half);  // positive toward -x
  return {Vec3(motor_x(lengths, side) - crank * from_z.sin, 0.0, crank * from_z.cos),
          Vec3(-crank * from_z.cos, 0.0, -crank * from_z.sin)};
}

// Solves one leg in its own frame, P = Rz(azimuth)^T p - (r, s, 0). The angle theta3 follows from
// P_y. With q, the parallelogram's length as seen in the leg's plane, the condition
//   |P + (c, 0, 0) - a (cos theta1, 0, sin theta1)| = q
// is a quadratic in tan(theta1 / 2).
void solve_leg(const DeltaLengths& lengths, std::size_t number, const Vec3& p_B,
               MechanismPose& pose) {
  const LegAzimuth& leg = lengths.legs[number];
  const double arm = lengths.arm_m;
  const double platform = lengths.platform_m;
  const double px = leg.cos * p_B.x() + leg.sin * p_B.y() - lengths.base_m;
  const double py = -leg.sin * p_B.x() + leg.cos * p_B.y() - lengths.base_across_m;
  const double pz = p_B.z();

  const double cos3 = (py + lengths.platform_across_m) / lengths.rod_m;
  const double sin3 = guarded_root(1.0 - cos3 * cos3, pose.reachable);
  const double q = lengths.rod_m * sin3 + lengths.end_pieces_m;

  const double inner = px + platform - arm;
  const double outer = px + platform + arm;
  const double l0 = pz * pz + inner * inner - q * q;
  const double l2 = pz * pz + outer * outer - q * q;
  const double half_l1 = 2.0 * arm * pz;
  const double scale = arm * arm * arm * arm;
  const double root =
      std::sqrt(scale) * guarded_root((half_l1 * half_l1 - l0 * l2) / scale, pose.reachable);
  // The root with the elbow outward, in the form that does not subtract nearly equal numbers.
  const double tan_half = l0 / (half_l1 + root);

  const auto [cos1, sin1] = turn_of(tan_half);
  const double cos2 = (px + platform - arm * cos1) / q;
  const double sin2 = guarded_root(1.0 - cos2 * cos2, pose.reachable);
  const double gain = -1.0 / (arm * sin3 * (sin1 * cos2 - cos1 * sin2));
  pose.coordinate[number] = tan_half;
  pose.rows[number] = gain * Vec3(leg.cos * cos2 * sin3 - leg.sin * cos3,
                                  leg.sin * cos2 * sin3 + leg.cos * cos3, sin2 * sin3);
}

// Returns the unit vector from the base's axis to the leg.
Vec3 outward(const LegAzimuth& leg) {
  return {leg.cos, leg.sin, 0.0};
}

}  // namespace

double guarded_root(double square, bool& reachable) {
  reachable = reachable && square >= kSmallestSquare;
  return std::sqrt(std::max(square, kSmallestSquare));
}

Turn turn_of(double tan_half) {
  const double norm = 1.0 + tan_half * tan_half;
  return {.cos = (1.0 - tan_half * tan_half) / norm, .sin = 2.0 * tan_half / norm};
}

void solve_delta(const DeltaLengths& lengths, const Vec3& p_B, MechanismPose& pose) {
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    solve_leg(lengths, i, p_B, pose);
  }
}

Vec3 delta_elbow_sum(const DeltaLengths& lengths, const MechanismPose& pose) {
  Vec3 sum_B = Vec3::Zero();
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    const Turn turn = turn_of(pose.coordinate[i]);
    sum_B += (lengths.base_m + lengths.arm_m * turn.cos) * outward(lengths.legs[i]) +
             lengths.base_across_m * Vec3(-lengths.legs[i].sin, lengths.legs[i].cos, 0.0) +
             lengths.arm_m * turn.sin * Vec3::UnitZ();
  }
  return sum_B;
}

// The weight's moment about each shoulder, turned into a force at the handle by the leg's row.
Vec3 delta_elbow_pull(const DeltaLengths& lengths, const MechanismPose& pose,
                      const Vec3& gravity_B) {
  Vec3 pull_B = Vec3::Zero();
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    const Turn turn = turn_of(pose.coordinate[i]);
    const double moment = lengths.arm_m * (turn.cos * gravity_B.z() -
                                           turn.sin * outward(lengths.legs[i]).dot(gravity_B));
    pull_B += moment * pose.rows[i];
  }
  return pull_B;
}

// The handle's angle from straight up is atan2(x, y), so tan(half) = x / (radius + y). The floor
// keeps both finite for a point on the axis.
void solve_paddle(const PaddleLengths& lengths, const Vec3& p_B, MechanismPose& pose) {
  const double level = lengths.radius_m * lengths.radius_m;
  const double square =
      level * std::max((p_B.x() * p_B.x() + p_B.y() * p_B.y()) / level, kSmallestSquare);
  pose.rows = {Vec3(p_B.y(), -p_B.x(), 0.0) / square, Vec3::Zero(), Vec3::Zero()};
  pose.coordinate = {p_B.x() / (std::sqrt(square) + p_B.y()), 0.0, 0.0};
}

// For each side |p - elbow| = L, the distal link. Let v point from the motor to p, and let a be the
// crank's angle from z toward -x. Then
//   v_z cos a - v_x sin a = k,   k = (v^2 + l^2 - L^2) / 2 l,
// which is a quadratic in tan(a / 2); the root with the elbow outward is taken. The distal link
// keeps its length while the crank turns: (p - elbow) . (v - elbow') = 0, and (p - elbow) . elbow'
// = -+ l root, which gives the crank's rate.
void solve_pantograph(const PantographLengths& lengths, const Vec3& p_B, MechanismPose& pose) {
  const double proximal = lengths.proximal_m;
  const double distal = lengths.distal_m;
  for (std::size_t side = 0; side < 2; ++side) {
    const double outward = side == 0 ? 1.0 : -1.0;
    const double vx = p_B.x() - motor_x(lengths, side);
    const double vz = p_B.z();
    const double square = vx * vx + vz * vz;
    const double k = (square + proximal * proximal - distal * distal) / (2.0 * proximal);
    const double root =
        proximal * guarded_root((square - k * k) / (proximal * proximal), pose.reachable);
    pose.coordinate[side] = (-vx + outward * root) / (k + vz);
    const CrankPose crank = crank_of(lengths, side, pose.coordinate[side]);
    pose.rows[side] = Vec3(p_B.x() - crank.elbow_B.x(), 0.0, vz - crank.elbow_B.z()) /
                      (-outward * proximal * root);
  }
  pose.rows[2].setZero();
  pose.coordinate[2] = 0.0;
}

Vec3 pantograph_elbow_sum(const PantographLengths& lengths, const MechanismPose& pose) {
  return crank_of(lengths, 0, pose.coordinate[0]).elbow_B +
         crank_of(lengths, 1, pose.coordinate[1]).elbow_B;
}

Vec3 pantograph_elbow_pull(const PantographLengths& lengths, const MechanismPose& pose,
                           const Vec3& gravity_B) {
  Vec3 pull_B = Vec3::Zero();
  for (std::size_t side = 0; side < 2; ++side) {
    pull_B +=
        crank_of(lengths, side, pose.coordinate[side]).slope_B.dot(gravity_B) * pose.rows[side];
  }
  return pull_B;
}

// In the vertical plane of the arm (r outward, h up), shoulder, elbow and handle form a triangle
// with the elbow above. A velocity along the forearm is made by the upper arm alone, and one along
// the upper arm by the forearm alone: that gives the rows without a matrix inverse.
void solve_serial_arm(const ArmLengths& lengths, const Vec3& p_B, MechanismPose& pose) {
  const double upper = lengths.upper_m;
  const double forearm = lengths.forearm_m;
  const double whole = upper + forearm;
  const double r = whole * guarded_root((p_B.x() * p_B.x() + p_B.z() * p_B.z()) / (whole * whole),
                                        pose.reachable);
  const double h = p_B.y() - lengths.shoulder_m;
  const double sin1 = p_B.x() / r;
  const double cos1 = p_B.z() / r;

  const double reach = std::sqrt(r * r + h * h);
  const double along = (upper * upper + reach * reach - forearm * forearm) / (2.0 * reach);
  const double across = upper * guarded_root(1.0 - along * along / (upper * upper), pose.reachable);
  const double elbow_r = (along * r - across * h) / reach;
  const double elbow_h = (along * h + across * r) / reach;
  const Turn u{.cos = elbow_r / upper, .sin = elbow_h / upper};
  const Turn f{.cos = (r - elbow_r) / forearm, .sin = (h - elbow_h) / forearm};
  pose.coordinate = {p_B.x() / (r + p_B.z()), u.sin / (1.0 + u.cos), f.sin / (1.0 + f.cos)};

  const double between = u.cos * f.sin - u.sin * f.cos;
  pose.rows[0] = Vec3(cos1, 0.0, -sin1) / r;
  pose.rows[1] = Vec3(sin1 * f.cos, f.sin, cos1 * f.cos) / (upper * between);
  pose.rows[2] = Vec3(sin1 * u.cos, u.sin, cos1 * u.cos) / (-forearm * between);
}

Vec3 serial_arm_elbow(const ArmLengths& lengths, const MechanismPose& pose) {
  const Turn azimuth = turn_of(pose.coordinate[0]);
  const Turn u = turn_of(pose.coordinate[1]);
  return {lengths.upper_m * u.cos * azimuth.sin, lengths.shoulder_m + lengths.upper_m * u.sin,
          lengths.upper_m * u.cos * azimuth.cos};
}

// The weight's moments about the azimuth's axis and the upper arm's axis, turned into forces at the
// handle by the rows. The forearm's joint does not move the elbow.
Vec3 serial_arm_elbow_pull(const ArmLengths& lengths, const MechanismPose& pose,
                           const Vec3& gravity_B) {
  const Turn azimuth = turn_of(pose.coordinate[0]);
  const Vec3 from_shoulder_B = serial_arm_elbow(lengths, pose) - Vec3(0.0, lengths.shoulder_m, 0.0);
  const Vec3 moment_B = from_shoulder_B.cross(gravity_B);
  const Vec3 raising_axis_B(-azimuth.cos, 0.0, azimuth.sin);
  return moment_B.y() * pose.rows[0] + moment_B.dot(raising_axis_B) * pose.rows[1];
}

}  // namespace tactus::host
