// The Falcon's arms as a chain of bodies, solved by bisection: the oracle for the delta's closed
// forms, and written from the drawing rather than from them.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "rendering/geometry/vector.h"

namespace tactus::firmware {

// Returns by how much the rod of the leg at `azimuth_deg` would be too long, m, with its arm at
// angle `t`. The hinges at the rod's ends stand off by 11.25 mm each, within the plane that the arm
// turns in.
inline double rod_error(double azimuth_deg, double t, const Vec3& tool) {
  const Vec3 z = Vec3::UnitZ();
  const Mat3 turn = Eigen::AngleAxisd(azimuth_deg * std::numbers::pi / 180.0, z).toRotationMatrix();
  const Vec3 outward = turn * Vec3::UnitX();
  const Vec3 across = turn * Vec3::UnitY();
  const Vec3 elbow =
      0.0400 * outward - 0.02309 * across + 0.060 * (std::cos(t) * outward + std::sin(t) * z);
  const Vec3 hinge = tool + 0.01443 * outward - 0.025 * across;
  const Vec3 span = hinge - elbow;
  const Vec3 in_plane = span - span.dot(across) * across;
  const Vec3 rod = span - (0.01125 + 0.01125) * in_plane.normalized();
  return rod.dot(in_plane) > 0.0 ? rod.norm() - 0.1025 : -0.1025;
}

// The arm's angle for a tool position: of the two, the one with the elbow outward, where turning
// the arm toward the user slackens the rod.
inline std::optional<double> bisected_angle(double azimuth_deg, const Vec3& tool) {
  constexpr int kSteps = 180;
  constexpr double kStep = 2.0 * std::numbers::pi / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    double low = -std::numbers::pi + kStep * i;
    double high = low + kStep;
    if (rod_error(azimuth_deg, low, tool) <= 0.0 || rod_error(azimuth_deg, high, tool) > 0.0) {
      continue;
    }
    while (true) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) {
        return middle;
      }
      (rod_error(azimuth_deg, middle, tool) > 0.0 ? low : high) = middle;
    }
  }
  return std::nullopt;
}

inline std::optional<Vec3> bisected_joints(const Vec3& tool) {
  Vec3 joints;
  constexpr std::array<double, 3> kAzimuth_deg = {105.0, -15.0, -135.0};
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const std::optional<double> angle = bisected_angle(kAzimuth_deg[leg], tool);
    if (!angle) {
      return std::nullopt;
    }
    joints[static_cast<Eigen::Index>(leg)] = *angle;
  }
  return joints;
}

}  // namespace tactus::firmware
