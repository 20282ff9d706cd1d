// Derivation. In leg i's frame (u outward along its azimuth, v across, w = z) the elbow is at
//   E = (r + a cos t, s, a sin t),   t the arm's angle,
// and the platform's hinge at R^T p + (c, f, 0). Let w be the vector from elbow to platform hinge.
// The parallelogram lets its rods (length b) turn about hinges that stand off by k in all within
// the leg's plane, so
//   (h - k)^2 + w_v^2 = b^2,   h = sqrt(w_u^2 + w_w^2).
// With g = ((h - k)^2 + w_v^2 - b^2) / 2b, the gradient of g by p is
//   n = ((h - k)/b w_u/h, w_v/b, (h - k)/b w_w/h),
// the unit vector along the rod (in Stamper's angles: sin t3 cos t2, cos t3, sin t3 sin t2).
// Differentiating by time,
//   N p' = D t',   rows n_i of N,   D_i = n_i . dE_i/dt_i,
// so J = N^-1 D, and no angle but t itself is ever formed. N singular: the platform can move with
// all arms held, and the torques for a force have no bound. D_i zero: arm i points along its rod,
// and its motor cannot move the tool.
#include "firmware/kinematics/delta.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "firmware/limits.h"

namespace tactus::firmware {
namespace {

// The last Newton step is below this: convergence is quadratic, so the next step would be below
// rounding (1e-17 m).
constexpr double kLastStep_m = 1e-10;
// A longer Newton step is cut to this length, because far from the solution the linear model is
// wrong.
constexpr double kLongestStep_m = 0.03;

// The thresholds of a singular pose, with the Falcon's values of both quantities:
// | pose                                  | -det N, the volume that the rods span | D/a  |
// | its centre                            | 0.82                                  | 0.96 |
// | farthest reach on its axis, z = 0.18 m| 0.18                                  |      |
// | nearest, z = 0.06 m                   |                                       | 0.06 |
// The signs are those of the Falcon's own assembly; the mirrored ones fail the same tests.
constexpr double kLeastRodVolume = 0.1;
constexpr double kLeastLeverage = 0.05;

}  // namespace

Delta::Delta(const DeltaGeometry& geometry) : geometry_(geometry) {
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const rendering::SineCosine azimuth = rendering::sine_cosine(geometry.azimuth_rad[leg]);
    azimuth_sine_[leg] = azimuth.sine;
    azimuth_cosine_[leg] = azimuth.cosine;
  }
}

Vec3 Delta::in_leg_frame(std::size_t leg, const Vec3& v_D) const {
  const double s = azimuth_sine_[leg];
  const double c = azimuth_cosine_[leg];
  return {c * v_D.x() + s * v_D.y(), -s * v_D.x() + c * v_D.y(), v_D.z()};
}

Delta::Rods Delta::rods(const Vec3& p_D, const Offsets& offset) const {
  const double b = geometry_.rod_m;
  Rods rods;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Vec3 w = in_leg_frame(leg, p_D) + offset[leg];
    const double h = std::sqrt(w.x() * w.x() + w.z() * w.z());
    const double planar = h - geometry_.hinge_offset_m;
    const double u = planar / b * (w.x() / h);
    const double v = w.y() / b;
    const double s = azimuth_sine_[leg];
    const double c = azimuth_cosine_[leg];
    const auto row = static_cast<Eigen::Index>(leg);
    rods.direction_D.row(row) << c * u - s * v, s * u + c * v, planar / b * (w.z() / h);
    rods.reach[row] = planar / b;
    rods.excess_m[row] = (planar * planar + w.y() * w.y() - b * b) / (2.0 * b);
  }
  return rods;
}

std::optional<Delta::Solution> Delta::solve(const Offsets& offset, const Vec3& seed_D) const {
  Vec3 p_D = seed_D;
  for (int step = 0; step < kMaxNewtonSteps; ++step) {
    const Rods now = rods(p_D, offset);
    const Vec3 move = -(now.direction_D.inverse() * now.excess_m);
    const double length = move.norm();
    if (!std::isfinite(length)) {
      return std::nullopt;
    }
    // Newton's step: to first order a motion changes the lengths by N . move, which has to be
    // -excess.
    p_D += length > kLongestStep_m ? Vec3(move * (kLongestStep_m / length)) : move;
    if (length < kLastStep_m) {
      const Rods last = rods(p_D, offset);
      // The equations also hold for mirrored and folded assemblies, which the device cannot reach.
      const bool as_built = last.direction_D.determinant() < 0.0 && last.reach.minCoeff() > 0.0;
      return as_built ? std::optional<Solution>({p_D, last.direction_D}) : std::nullopt;
    }
  }
  return std::nullopt;
}

Pose Delta::assemble(const Arms& arms, const Vec3& seed_D) const {
  const DeltaGeometry& g = geometry_;
  Offsets offset;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    offset[leg] = {g.platform_radius_m - g.base_radius_m - g.arm_m * arms[leg].cosine,
                   g.platform_tangent_m - g.base_tangent_m, -g.arm_m * arms[leg].sine};
  }
  const std::optional<Solution> found = solve(offset, seed_D);
  if (!found) {
    return {seed_D, Mat3::Zero(), kPoseNotConverged};
  }
  Vec3 leverage;  // D / a
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const auto row = static_cast<Eigen::Index>(leg);
    const Vec3 n = in_leg_frame(leg, found->rods_D.row(row).transpose());
    leverage[row] = arms[leg].cosine * n.z() - arms[leg].sine * n.x();
  }
  if (-found->rods_D.determinant() < kLeastRodVolume || leverage.minCoeff() < kLeastLeverage) {
    return {found->p_D, Mat3::Zero(), kPoseSingular};
  }
  return {found->p_D, found->rods_D.inverse() * (g.arm_m * leverage).asDiagonal(), kPoseGood};
}

// Tries the nominal pose as a second seed: a seed far away may lead to no pose or to a folded
// assembly.
Pose Delta::forward(const Vec3& joints, const Vec3& seed_D) const {
  const Arms arms = {rendering::sine_cosine(joints.x()), rendering::sine_cosine(joints.y()),
                     rendering::sine_cosine(joints.z())};
  Pose near_seed = assemble(arms, seed_D);
  if (near_seed.status == kPoseGood) {
    return near_seed;
  }
  Pose near_nominal = assemble(arms, {0.0, 0.0, geometry_.nominal_height_m});
  return near_nominal.status == kPoseGood ? near_nominal : near_seed;
}

std::optional<Vec3> Delta::inverse(const Vec3& p_D) const {
  const DeltaGeometry& g = geometry_;
  Vec3 joints;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Vec3 hinge = in_leg_frame(leg, p_D) + Vec3(g.platform_radius_m - g.base_radius_m,
                                                     g.platform_tangent_m - g.base_tangent_m, 0.0);
    // The sine of the angle by which the rods leave the leg's plane.
    const double across = hinge.y() / g.rod_m;
    if (!(std::abs(across) < 1.0)) {
      return std::nullopt;
    }
    // The triangle in the leg's plane has the sides a (arm), q (rod and hinge offsets) and l (motor
    // axis to platform hinge).
    const double q = g.rod_m * std::sqrt(1.0 - across * across) + g.hinge_offset_m;
    const double l = std::hypot(hinge.x(), hinge.z());
    const double cosine = (g.arm_m * g.arm_m + l * l - q * q) / (2.0 * g.arm_m * l);
    if (!(std::abs(cosine) <= 1.0)) {
      return std::nullopt;
    }
    joints[static_cast<Eigen::Index>(leg)] = std::atan2(hinge.z(), hinge.x()) - std::acos(cosine);
  }
  return joints;
}

// Half of the rods' mass moves with the elbow, half with the platform.
Vec3 Delta::gravity_effort(const Vec3& joints, const Pose& pose, const Vec3& gravity_D) const {
  const DeltaGeometry& g = geometry_;
  const double arm_kg_m = g.arm.moment_kg_m() + 0.5 * g.rods_kg * g.arm_m;
  const double platform_kg = g.platform_kg + 1.5 * g.rods_kg;
  Vec3 effort = -platform_kg * joint_effort(pose, gravity_D);
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const auto axis = static_cast<Eigen::Index>(leg);
    const rendering::SineCosine turn = rendering::sine_cosine(joints[axis]);
    const Vec3 gravity = in_leg_frame(leg, gravity_D);
    effort[axis] -= arm_kg_m * (turn.cosine * gravity.z() - turn.sine * gravity.x());
  }
  return effort;
}

bool has_weight(const DeltaGeometry& g) {
  return g.arm.moment_kg_m() != 0.0 || g.rods_kg != 0.0 || g.platform_kg != 0.0;
}

void check_geometry(RangeCheck& check, const DeltaGeometry& g) {
  check_link(check, "mechanism.arm_m", g.arm_m);
  check_link(check, "mechanism.rod_m", g.rod_m);
  check.in("mechanism.hinge_offset_m", g.hinge_offset_m, 0.0, g.rod_m);
  check.in("mechanism.base_radius_m", g.base_radius_m, 0.0, 1.0);
  check.in("mechanism.base_tangent_m", g.base_tangent_m, -1.0, 1.0);
  check.in("mechanism.platform_radius_m", g.platform_radius_m, 0.0, 1.0);
  check.in("mechanism.platform_tangent_m", g.platform_tangent_m, -1.0, 1.0);
  for (const double azimuth : g.azimuth_rad) {
    check.in("mechanism.azimuth_rad", azimuth, -6.3, 6.3);
  }
  check.in("mechanism.nominal_height_m", g.nominal_height_m, 0.0, 2.0);
  check_weight(check, {"mechanism.arm.mass_kg", "mechanism.arm.centre_m"}, g.arm);
  check_mass(check, "mechanism.rods_kg", g.rods_kg);
  check_mass(check, "mechanism.platform_kg", g.platform_kg);
}

std::span<const drivers::Binding<DeltaGeometry>> Delta::keys() {
  using G = DeltaGeometry;
  static constexpr std::array kKeys{
      drivers::bind<&G::arm_m>("arm_m", "m"),
      drivers::bind<&G::rod_m>("rod_m", "m"),
      drivers::bind<&G::hinge_offset_m>("hinge_offset_m", "m"),
      drivers::bind<&G::base_radius_m>("base_radius_m", "m"),
      drivers::bind<&G::base_tangent_m>("base_tangent_m", "m"),
      drivers::bind<&G::platform_radius_m>("platform_radius_m", "m"),
      drivers::bind<&G::platform_tangent_m>("platform_tangent_m", "m"),
      drivers::bind<&G::azimuth_rad>("azimuth_rad", "rad"),
      drivers::bind<&G::nominal_height_m>("nominal_height_m", "m"),
      drivers::bind<&G::arm, &LinkWeight::mass_kg>("arm_kg", "kg"),
      drivers::bind<&G::arm, &LinkWeight::centre_m>("arm_centre_m", "m"),
      drivers::bind<&G::rods_kg>("rods_kg", "kg"),
      drivers::bind<&G::platform_kg>("platform_kg", "kg"),
  };
  return kKeys;
}

}  // namespace tactus::firmware
