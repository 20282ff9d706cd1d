// Derivation. In the plane, let E_i be the elbows, E_i' = dE_i/dq_i, and n_i the unit vector along
// distal link i, elbow to tool. The links keep their length:
//   n_i . (p' - E_i' q_i') = 0,   so   N p' = D q',   rows n_i of N,   D_i = n_i . E_i'.
// J = N^-1 D. det N is the sine of the angle between the distal links: zero where they lie in one
// line, and the tool can move with both motors held. D_i / l is the sine of the angle between the
// links of side i: zero where they lie in one line, and motor i cannot move the tool.
#include "firmware/kinematics/pantograph.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "rendering/geometry/portable_math.h"

namespace tactus::firmware {
namespace {

// A vector in the plane of the linkage: x and z of D.
using InPlane = Eigen::Vector2d;

// The threshold of a singular pose. At the Haply's home (180 and 0 degrees) the sine between the
// distal links is 0.88 and the leverage 0.52; at the far end, arms at 90 degrees, 0.28 and 0.14.
constexpr double kLeastSineOfRods = 0.1;
constexpr double kLeastSineOfElbow = 0.05;
// Below this distance between the elbows the direction from one to the other is only rounding
// error.
constexpr double kSmallestGap_m = 1e-9;

// Returns the vector in frame D.
Vec3 in_device(const InPlane& v) {
  return {v.x(), 0.0, v.y()};
}

// A proximal link at one angle.
struct Crank {
  InPlane elbow;
  // The derivative of the elbow's position by the joint, m/rad.
  InPlane slope;
};

// Returns the proximal link of the motor at x = base_m.
Crank crank(double base_m, double length_m, double joint) {
  const rendering::SineCosine turn = rendering::sine_cosine(joint);
  return {{base_m + length_m * turn.cosine, length_m * turn.sine},
          {-length_m * turn.sine, length_m * turn.cosine}};
}

}  // namespace

Pose Pantograph::forward(const Vec3& joints, const Vec3& seed_D) const {
  const PantographGeometry& g = geometry_;
  const Crank first = crank(0.0, g.proximal_m, joints.x());
  const Crank second = crank(g.base_m, g.proximal_m, joints.y());
  const InPlane way = second.elbow - first.elbow;
  const double gap = way.norm();
  const double height_squared = g.distal_m * g.distal_m - 0.25 * gap * gap;
  const bool meets = gap > kSmallestGap_m && height_squared >= 0.0;
  if (!meets) {
    return {seed_D, Mat3::Zero(), kPoseNotConverged};
  }
  // The tool is the apex of the triangle on the line between the elbows, whose other sides are the
  // distal links; `left` is square to that line.
  const InPlane left(-way.y() / gap, way.x() / gap);
  const InPlane tool = first.elbow + 0.5 * way + std::sqrt(height_squared) * left;

  const InPlane n1 = (tool - first.elbow) / g.distal_m;
  const InPlane n2 = (tool - second.elbow) / g.distal_m;
  const double sine_of_rods = n1.x() * n2.y() - n1.y() * n2.x();
  const double d1 = n1.dot(first.slope);
  const double d2 = n2.dot(second.slope);
  const double sine_of_elbow = std::min(-d1, d2) / g.proximal_m;
  Pose pose{in_device(tool), Mat3::Zero(), kPoseSingular};
  if (sine_of_rods >= kLeastSineOfRods && sine_of_elbow >= kLeastSineOfElbow) {
    pose.status = kPoseGood;
    // The columns of J = N^-1 D by Cramer's rule.
    pose.jacobian_D.col(0) = in_device({n2.y(), -n2.x()}) * (d1 / sine_of_rods);
    pose.jacobian_D.col(1) = in_device({-n1.y(), n1.x()}) * (d2 / sine_of_rods);
  }
  return pose;
}

std::optional<PantographJoints> Pantograph::inverse(const Vec3& p_D) const {
  const PantographGeometry& g = geometry_;
  PantographJoints joints{};
  for (std::size_t side = 0; side < 2; ++side) {
    const double x = p_D.x() - (side == 0 ? 0.0 : g.base_m);
    const double reach = std::hypot(x, p_D.z());
    // The law of cosines gives the angle between the line to the tool and the proximal link.
    const double cosine = (g.proximal_m * g.proximal_m + reach * reach - g.distal_m * g.distal_m) /
                          (2.0 * g.proximal_m * reach);
    const bool is_triangle = std::abs(cosine) <= 1.0;
    if (!is_triangle) {
      return std::nullopt;
    }
    const double outward = side == 0 ? 1.0 : -1.0;
    joints[side] = std::atan2(p_D.z(), x) + outward * std::acos(cosine);
  }
  return joints;
}

// A distal link's centre of mass is at the share c / L of the link, from its elbow to the tool.
Vec3 Pantograph::gravity_effort(const Vec3& joints, const Pose& pose, const Vec3& gravity_D) const {
  const PantographGeometry& g = geometry_;
  const double toward_tool_kg = g.distal.moment_kg_m() / g.distal_m;
  const double at_elbow_kg =
      g.proximal.moment_kg_m() / g.proximal_m + g.distal.mass_kg - toward_tool_kg;
  const double at_tool_kg = 2.0 * toward_tool_kg + g.tool_kg;
  const InPlane gravity(gravity_D.x(), gravity_D.z());
  const Vec3 by_elbows(crank(0.0, g.proximal_m, joints.x()).slope.dot(gravity),
                       crank(0.0, g.proximal_m, joints.y()).slope.dot(gravity), 0.0);
  return -at_elbow_kg * by_elbows - at_tool_kg * joint_effort(pose, gravity_D);
}

bool has_weight(const PantographGeometry& g) {
  return g.proximal.moment_kg_m() != 0.0 || g.distal.mass_kg != 0.0 || g.tool_kg != 0.0;
}

void check_geometry(RangeCheck& check, const PantographGeometry& g) {
  check.in("mechanism.base_m", g.base_m, 0.0, kLongestLink_m);
  check_link(check, "mechanism.proximal_m", g.proximal_m);
  check_link(check, "mechanism.distal_m", g.distal_m);
  check_weight(check, {"mechanism.proximal.mass_kg", "mechanism.proximal.centre_m"}, g.proximal);
  check_weight(check, {"mechanism.distal.mass_kg", "mechanism.distal.centre_m"}, g.distal);
  check_mass(check, "mechanism.tool_kg", g.tool_kg);
}

std::span<const drivers::Binding<PantographGeometry>> Pantograph::keys() {
  using G = PantographGeometry;
  static constexpr std::array kKeys{
      drivers::bind<&G::base_m>("base_m", "m"),
      drivers::bind<&G::proximal_m>("proximal_m", "m"),
      drivers::bind<&G::distal_m>("distal_m", "m"),
      drivers::bind<&G::proximal, &LinkWeight::mass_kg>("proximal_kg", "kg"),
      drivers::bind<&G::proximal, &LinkWeight::centre_m>("proximal_centre_m", "m"),
      drivers::bind<&G::distal, &LinkWeight::mass_kg>("distal_kg", "kg"),
      drivers::bind<&G::distal, &LinkWeight::centre_m>("distal_centre_m", "m"),
      drivers::bind<&G::tool_kg>("tool_kg", "kg"),
  };
  return kKeys;
}

}  // namespace tactus::firmware
