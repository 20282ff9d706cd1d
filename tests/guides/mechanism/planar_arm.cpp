#include "firmware/kinematics/planar_arm.h"

#include <cmath>

#include "rendering/geometry/portable_math.h"

namespace tactus::firmware {

Pose PlanarArm::forward(const Vec3& joints, const Vec3& /*seed_D*/) const {
  constexpr double kLeastSine = 0.1;
  const rendering::SineCosine inner = rendering::sine_cosine(joints.x());
  const rendering::SineCosine outer = rendering::sine_cosine(joints.y());
  const Vec3 to_elbow = geometry_.inner_m * Vec3(inner.cosine, 0.0, inner.sine);
  const Vec3 to_tool = geometry_.outer_m * Vec3(outer.cosine, 0.0, outer.sine);
  Pose pose{to_elbow + to_tool, Mat3::Zero(), kPoseSingular};
  const double sine_between = inner.cosine * outer.sine - inner.sine * outer.cosine;
  if (std::abs(sine_between) >= kLeastSine) {
    pose.status = kPoseGood;
    pose.jacobian_D.col(0) << -to_elbow.z(), 0.0, to_elbow.x();
    pose.jacobian_D.col(1) << -to_tool.z(), 0.0, to_tool.x();
  }
  return pose;
}

std::span<const drivers::Binding<PlanarArmGeometry>> PlanarArm::keys() {
  static constexpr std::array kKeys{
      drivers::bind<&PlanarArmGeometry::inner_m>("inner_m", "m"),
      drivers::bind<&PlanarArmGeometry::outer_m>("outer_m", "m"),
  };
  return kKeys;
}

void check_geometry(RangeCheck& check, const PlanarArmGeometry& g) {
  check_link(check, "mechanism.inner_m", g.inner_m);
  check_link(check, "mechanism.outer_m", g.outer_m);
}

}  // namespace tactus::firmware
