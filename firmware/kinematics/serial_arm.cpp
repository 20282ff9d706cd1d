// Derivation. With the unit vectors
//   u = (s1 c2, s2, c1 c2) along the upper arm,   f = (s1 s3, -c3, c1 s3) along the forearm,
// the tool is at p = height y + l u + m f, and J = l du/dq + m df/dq. Its determinant is
//   l m cos(q2 - q3) R,   R = l c2 + m s3,
// where R is the tool's distance from the first axis and q2 - q3 +- 90 degrees the angle between
// the links. J^T f is bounded everywhere, but near either zero a force in the lost direction would
// have no effort, and a count of an encoder would be a long way of the tool.
#include "firmware/kinematics/serial_arm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "rendering/geometry/portable_math.h"

namespace tactus::firmware {
namespace {

// The thresholds of a singular pose: R as a share of the whole arm, and the cosine above. The
// PHANToM's own limits (q2 - q3 from -55 to 65 degrees) leave 0.42 of the latter.
constexpr double kLeastShareOfReach = 0.05;
constexpr double kLeastSineOfLinks = 0.1;

// The directions u and f and their derivatives by the joints.
struct Links {
  Vec3 upper_D;
  Vec3 forearm_D;
  Vec3 upper_by_azimuth_D;
  Vec3 upper_by_elevation_D;
  Vec3 forearm_by_azimuth_D;
  Vec3 forearm_by_angle_D;
  double sine_between = 0.0;  // cos(q2 - q3)
};

// Returns the links' directions for the joints, rad.
Links links(const Vec3& joints) {
  const auto [s1, c1] = rendering::sine_cosine(joints.x());
  const auto [s2, c2] = rendering::sine_cosine(joints.y());
  const auto [s3, c3] = rendering::sine_cosine(joints.z());
  return {.upper_D = {s1 * c2, s2, c1 * c2},
          .forearm_D = {s1 * s3, -c3, c1 * s3},
          .upper_by_azimuth_D = {c1 * c2, 0.0, -s1 * c2},
          .upper_by_elevation_D = {-s1 * s2, c2, -c1 * s2},
          .forearm_by_azimuth_D = {c1 * s3, 0.0, -s1 * s3},
          .forearm_by_angle_D = {s1 * c3, s3, c1 * c3},
          .sine_between = c2 * c3 + s2 * s3};
}

// Returns the same angle within half a turn of `near`.
double unwound(double angle, double near) {
  return near + std::remainder(angle - near, 2.0 * std::numbers::pi);
}

}  // namespace

Pose SerialArm::forward(const Vec3& joints, const Vec3& /*seed_D*/) const {
  const SerialArmGeometry& g = geometry_;
  const Links at = links(joints);
  const Vec3 reach_D = g.upper_m * at.upper_D + g.forearm_m * at.forearm_D;
  Pose pose{reach_D + Vec3(0.0, g.shoulder_height_m, 0.0), Mat3::Zero(), kPoseSingular};
  const double from_axis = std::sqrt(reach_D.x() * reach_D.x() + reach_D.z() * reach_D.z());
  if (from_axis >= kLeastShareOfReach * (g.upper_m + g.forearm_m) &&
      std::abs(at.sine_between) >= kLeastSineOfLinks) {
    pose.status = kPoseGood;
    pose.jacobian_D.col(0) =
        g.upper_m * at.upper_by_azimuth_D + g.forearm_m * at.forearm_by_azimuth_D;
    pose.jacobian_D.col(1) = g.upper_m * at.upper_by_elevation_D;
    pose.jacobian_D.col(2) = g.forearm_m * at.forearm_by_angle_D;
  }
  return pose;
}

std::optional<Vec3> SerialArm::inverse(const Vec3& p_D, const Vec3& near) const {
  const SerialArmGeometry& g = geometry_;
  const double up = p_D.y() - g.shoulder_height_m;
  const double from_axis = std::hypot(p_D.x(), p_D.z());
  const double reach = std::hypot(from_axis, up);
  const double cosine = (g.upper_m * g.upper_m + reach * reach - g.forearm_m * g.forearm_m) /
                        (2.0 * g.upper_m * reach);
  const bool is_triangle = std::abs(cosine) <= 1.0;
  if (!is_triangle) {
    return std::nullopt;
  }
  // The angle at the shoulder between the line to the tool and the upper arm, by the law of
  // cosines.
  const double bend = std::acos(cosine);
  std::optional<Vec3> best;
  for (const double facing : {1.0, -1.0}) {
    // The arm reaches the point either facing it or turned away from it, each with the elbow to
    // either side.
    const double out = facing * from_axis;
    for (const double elbow : {1.0, -1.0}) {
      const double elevation = std::atan2(up, out) + elbow * bend;
      const double forearm =
          std::atan2(out - g.upper_m * std::cos(elevation), g.upper_m * std::sin(elevation) - up);
      const Vec3 joints(unwound(std::atan2(facing * p_D.x(), facing * p_D.z()), near.x()),
                        unwound(elevation, near.y()), unwound(forearm, near.z()));
      if (!best || (joints - near).squaredNorm() < (*best - near).squaredNorm()) {
        best = joints;
      }
    }
  }
  return best;
}

Vec3 SerialArm::gravity_effort(const Vec3& joints, const Pose& /*pose*/,
                               const Vec3& gravity_D) const {
  const SerialArmGeometry& g = geometry_;
  // The forearm's mass and the tool also hang on the end of the upper arm.
  const double upper_kg_m = g.upper.moment_kg_m() + (g.forearm.mass_kg + g.tool_kg) * g.upper_m;
  const double forearm_kg_m = g.forearm.moment_kg_m() + g.tool_kg * g.forearm_m;
  const Links at = links(joints);
  const Vec3 by_azimuth_D =
      upper_kg_m * at.upper_by_azimuth_D + forearm_kg_m * at.forearm_by_azimuth_D;
  return {-by_azimuth_D.dot(gravity_D), -upper_kg_m * at.upper_by_elevation_D.dot(gravity_D),
          -forearm_kg_m * at.forearm_by_angle_D.dot(gravity_D)};
}

bool has_weight(const SerialArmGeometry& g) {
  return g.upper.moment_kg_m() != 0.0 || g.forearm.mass_kg != 0.0 || g.tool_kg != 0.0;
}

void check_geometry(RangeCheck& check, const SerialArmGeometry& g) {
  check_link(check, "mechanism.upper_m", g.upper_m);
  check_link(check, "mechanism.forearm_m", g.forearm_m);
  check.in("mechanism.shoulder_height_m", g.shoulder_height_m, -2.0, 2.0);
  check_weight(check, {"mechanism.upper.mass_kg", "mechanism.upper.centre_m"}, g.upper);
  check_weight(check, {"mechanism.forearm.mass_kg", "mechanism.forearm.centre_m"}, g.forearm);
  check_mass(check, "mechanism.tool_kg", g.tool_kg);
}

std::span<const drivers::Binding<SerialArmGeometry>> SerialArm::keys() {
  using G = SerialArmGeometry;
  static constexpr std::array kKeys{
      drivers::bind<&G::upper_m>("upper_m", "m"),
      drivers::bind<&G::forearm_m>("forearm_m", "m"),
      drivers::bind<&G::shoulder_height_m>("shoulder_height_m", "m"),
      drivers::bind<&G::upper, &LinkWeight::mass_kg>("upper_kg", "kg"),
      drivers::bind<&G::upper, &LinkWeight::centre_m>("upper_centre_m", "m"),
      drivers::bind<&G::forearm, &LinkWeight::mass_kg>("forearm_kg", "kg"),
      drivers::bind<&G::forearm, &LinkWeight::centre_m>("forearm_centre_m", "m"),
      drivers::bind<&G::tool_kg>("tool_kg", "kg"),
  };
  return kKeys;
}

}  // namespace tactus::firmware
