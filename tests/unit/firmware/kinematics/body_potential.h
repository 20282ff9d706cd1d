// The potential energy of a mechanism's weights, body by body from the drawing: the oracle for the
// gravity efforts, which are closed forms of its slope.
#pragma once

#include <numbers>

#include <Eigen/Geometry>

#include "firmware/kinematics/mechanism.h"

namespace tactus::firmware {

// Returns a link's centre of mass, on the line from its inner to its outer joint, m.
inline Vec3 centre_between(const LinkWeight& weight, const Vec3& inner, const Vec3& outer) {
  return inner + weight.centre_m * (outer - inner).normalized();
}

inline Mat3 turned(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

// First moments about D's origin, kg m, with the tool at p_D.
inline Vec3 moment(const CartesianGeometry& g, const Vec3& p_D) {
  return {g.carried_kg[0] * p_D.x(), g.carried_kg[1] * p_D.y(), g.carried_kg[2] * p_D.z()};
}

inline Vec3 moment(const PaddleGeometry& g, const Vec3& p_D) {
  return g.paddle.mass_kg * centre_between(g.paddle, Vec3::Zero(), p_D);
}

inline Vec3 moment(const PantographGeometry& g, const Vec3& joints, const Vec3& p_D) {
  Vec3 sum = g.tool_kg * p_D;
  for (const int side : {0, 1}) {
    const Vec3 motor = side * g.base_m * Vec3::UnitX();
    const Vec3 elbow = motor + g.proximal_m * (turned(-joints[side], Vec3::UnitY()).col(0));
    sum += g.proximal.mass_kg * centre_between(g.proximal, motor, elbow) +
           g.distal.mass_kg * centre_between(g.distal, elbow, p_D);
  }
  return sum;
}

inline Vec3 moment(const DeltaGeometry& g, const Vec3& joints, const Vec3& p_D) {
  Vec3 sum = g.platform_kg * p_D;
  for (Eigen::Index leg = 0; leg < 3; ++leg) {
    const Mat3 turn = turned(g.azimuth_rad[static_cast<std::size_t>(leg)], Vec3::UnitZ());
    const Vec3 motor = turn * Vec3(g.base_radius_m, g.base_tangent_m, 0.0);
    const Vec3 elbow = motor + turn * turned(-joints[leg], Vec3::UnitY()) * Vec3(g.arm_m, 0.0, 0.0);
    const Vec3 hinge = p_D + turn * Vec3(g.platform_radius_m, g.platform_tangent_m, 0.0);
    sum += g.arm.mass_kg * centre_between(g.arm, motor, elbow) + 0.5 * g.rods_kg * (elbow + hinge);
  }
  return sum;
}

// The links as bodies that are swung up from hanging, then turned about the vertical.
inline Vec3 moment(const SerialArmGeometry& g, const Vec3& joints, const Vec3& p_D) {
  const Mat3 azimuth = turned(joints.x(), Vec3::UnitY());
  const Vec3 swing = -Vec3::UnitX();
  const Vec3 shoulder = g.shoulder_height_m * Vec3::UnitY();
  const Vec3 upper_arm =
      azimuth * turned(joints.y() + 0.5 * std::numbers::pi, swing) * -Vec3::UnitY();
  const Vec3 elbow = shoulder + g.upper_m * upper_arm;
  return g.upper.mass_kg * centre_between(g.upper, shoulder, elbow) +
         g.forearm.mass_kg * centre_between(g.forearm, elbow, p_D) + g.tool_kg * p_D;
}

// J, up to a constant; the tool at p_D, where these joints put it.
inline double body_potential(const MechanismGeometry& geometry, const Vec3& joints, const Vec3& p_D,
                             const Vec3& gravity_D) {
  if (const auto* paddle = std::get_if<PaddleGeometry>(&geometry)) {
    return -gravity_D.dot(moment(*paddle, p_D));
  }
  if (const auto* pantograph = std::get_if<PantographGeometry>(&geometry)) {
    return -gravity_D.dot(moment(*pantograph, joints, p_D));
  }
  if (const auto* delta = std::get_if<DeltaGeometry>(&geometry)) {
    return -gravity_D.dot(moment(*delta, joints, p_D));
  }
  if (const auto* arm = std::get_if<SerialArmGeometry>(&geometry)) {
    return -gravity_D.dot(moment(*arm, joints, p_D));
  }
  return -gravity_D.dot(moment(std::get<CartesianGeometry>(geometry), p_D));
}

}  // namespace tactus::firmware
