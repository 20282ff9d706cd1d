// A flat arm of two links that are both driven from the base, the outer one through a
// parallelogram.
//
// Frame D: origin on the axis of both motors, which is y; x right, z toward the user. Joint i is
// the angle (rad) of link i from +x toward +z, absolute. A force across the plane meets the
// bearings: it has no effort. The axis is upright, so that weights need no effort.
#pragma once

#include <span>

#include "drivers/common/setting.h"
#include "firmware/kinematics/pose.h"
#include "firmware/kinematics/range_check.h"

namespace tactus::firmware {

struct PlanarArmGeometry {
  double inner_m = 0.10;  // axis to elbow
  double outer_m = 0.08;  // elbow to tool
};

inline void transfer(rendering::StateArchive& archive, PlanarArmGeometry& geometry) {
  auto& [inner_m, outer_m] = geometry;
  archive(inner_m, outer_m);
}

class PlanarArm {
 public:
  using Geometry = PlanarArmGeometry;
  static constexpr std::size_t kJoints = 2;
  static constexpr bool kSlides = false;

  // The keys of [mechanism] in TOML.
  static std::span<const drivers::Binding<PlanarArmGeometry>> keys();

  explicit PlanarArm(const PlanarArmGeometry& geometry) : geometry_(geometry) {}

  // Returns the pose in closed form. It is singular if both links lie in one line.
  [[nodiscard]] Pose forward(const Vec3& joints, const Vec3& seed_D) const;

  [[nodiscard]] Vec3 gravity_effort(const Vec3& /*joints*/, const Pose& /*pose*/,
                                    const Vec3& /*gravity_D*/) const {
    return Vec3::Zero();
  }

 private:
  PlanarArmGeometry geometry_;
};

inline bool has_weight(const PlanarArmGeometry& /*g*/) {
  return false;
}

// Checks every field. An error names the field after "mechanism.".
void check_geometry(RangeCheck& check, const PlanarArmGeometry& g);

}  // namespace tactus::firmware
