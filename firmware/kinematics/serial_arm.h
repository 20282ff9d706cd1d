// The three-axis arm of the PHANToM Premium and of WoodenHaptics: an upper arm and a forearm in a
// plane that turns about the vertical. Both are driven from the base, the forearm through a
// parallelogram, so that its angle does not turn with the upper arm's. Pure functions of the
// geometry for any thread; real time, except `inverse`.
//
// Frame D: origin on the vertical axis at the base, x right, y up, z toward the user. Joints, rad:
//   1  azimuth: the plane from z (the arm reaches toward the user) toward x
//   2  elevation of the upper arm from the horizontal, growing upward
//   3  forearm, from hanging straight down, growing outward; absolute, not from the upper arm
// These are the PHANToM's angles. WoodenHaptics counts its second from the vertical, B = pi/2 - q2:
// its transmission needs a direction of -1 and an offset of pi/2 there. serial_arm.cpp derives the
// equations.
#pragma once

#include <optional>
#include <span>

#include "drivers/common/setting.h"
#include "firmware/kinematics/link_weight.h"
#include "firmware/kinematics/pose.h"
#include "firmware/kinematics/range_check.h"

namespace tactus::firmware {

// The dimensions of an arm. The defaults are the PHANToM Premium's.
struct SerialArmGeometry {
  // The distance from the shoulder to the elbow, m.
  double upper_m = 0.209550;
  // The distance from the elbow to the tool, m.
  double forearm_m = 0.169545;
  // The height of the second axis above the origin, m.
  double shoulder_height_m = 0.0;
  // The weights that turn with the upper arm, measured from the shoulder, and with the forearm,
  // from the elbow. A bar of the parallelogram belongs to the link parallel to it.
  LinkWeight upper;
  LinkWeight forearm;
  double tool_kg = 0.0;
};

inline void transfer(rendering::StateArchive& archive, SerialArmGeometry& geometry) {
  auto& [upper_m, forearm_m, shoulder_height_m, upper, forearm, tool_kg] = geometry;
  archive(upper_m, forearm_m, shoulder_height_m, upper, forearm, tool_kg);
}

// The kinematics of one geometry.
class SerialArm {
 public:
  using Geometry = SerialArmGeometry;
  static constexpr std::size_t kJoints = 3;
  static constexpr bool kSlides = false;

  // The keys of [mechanism] in TOML.
  static std::span<const drivers::Binding<SerialArmGeometry>> keys();

  explicit SerialArm(const SerialArmGeometry& geometry) : geometry_(geometry) {}

  // Returns the pose in closed form, which needs no seed. It is singular if the tool is over or
  // under the first axis, or if upper arm and forearm lie in one line.
  [[nodiscard]] Pose forward(const Vec3& joints, const Vec3& seed_D = Vec3::Zero()) const;

  // Returns the joints, rad, for a tool position, or nothing if it is out of reach. There are up to
  // four solutions (facing or turned away, elbow to either side); it takes the one nearest to
  // `near`, each joint within half a turn of it. Not part of the tick.
  [[nodiscard]] std::optional<Vec3> inverse(const Vec3& p_D, const Vec3& near) const;

  // Returns the efforts that hold the arm, N m. `gravity_D` is in m/s^2.
  [[nodiscard]] Vec3 gravity_effort(const Vec3& joints, const Pose& pose,
                                    const Vec3& gravity_D) const;

 private:
  SerialArmGeometry geometry_;
};

// Returns true if a weight is set.
bool has_weight(const SerialArmGeometry& g);

// Checks every field. An error names the field after "mechanism.".
void check_geometry(RangeCheck& check, const SerialArmGeometry& g);

}  // namespace tactus::firmware
