// The three-arm delta of the Novint Falcon. Pure functions of the geometry for any thread; real
// time, except where a function says otherwise.
//
// Three arms turn on the base, each joined to the grip's platform by a parallelogram of rods, so
// that the platform only translates. Frame D has its origin on the base's axis at the height of the
// motor axes, x to the right, y up, z from the base toward the user. Joint i is arm i's angle from
// the base plane, rad, growing toward the user; arms are top, right, left as the user sees them.
// delta.cpp derives the equations.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "drivers/common/setting.h"
#include "firmware/kinematics/link_weight.h"
#include "firmware/kinematics/pose.h"
#include "firmware/kinematics/range_check.h"
#include "hal/angle.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::firmware {

// The dimensions of a delta, lengths in m. The defaults are the Falcon's (R. E. Stamper's delta,
// with the figures of libnifalcon).
struct DeltaGeometry {
  // The length of an arm: the distance from its motor axis to the elbow.
  double arm_m = 0.060;
  // The length of the rods between the parallelogram's hinges.
  double rod_m = 0.1025;
  // The distance from the elbow to the rod's hinge plus that from the platform to the rod's hinge.
  double hinge_offset_m = 0.0225;
  // The distance from the base's axis to the motor axis, along the arm's azimuth.
  double base_radius_m = 0.0400;
  // The same distance, across the azimuth.
  double base_tangent_m = -0.02309;
  // The distance from the tool to the platform's hinge, along the azimuth.
  double platform_radius_m = 0.01443;
  // The same distance, across the azimuth.
  double platform_tangent_m = -0.025;
  // The directions of the arms in the base plane, from x toward y.
  std::array<double, 3> azimuth_rad = {hal::radians_of(105.0), hal::radians_of(-15.0),
                                       hal::radians_of(-135.0)};
  // A z inside the workspace: the iteration starts there if the seed leads nowhere.
  double nominal_height_m = 0.12;
  // The weight of each arm, from the motor axis toward the elbow.
  LinkWeight arm;
  // The mass of the pair of rods of one leg.
  double rods_kg = 0.0;
  // The mass of the platform with the grip.
  double platform_kg = 0.0;
};

inline void transfer(rendering::StateArchive& archive, DeltaGeometry& geometry) {
  auto& [arm_m, rod_m, hinge_offset_m, base_radius_m, base_tangent_m, platform_radius_m,
         platform_tangent_m, azimuth_rad, nominal_height_m, arm, rods_kg, platform_kg] = geometry;
  archive(arm_m, rod_m, hinge_offset_m, base_radius_m, base_tangent_m, platform_radius_m,
          platform_tangent_m, azimuth_rad, nominal_height_m, arm, rods_kg, platform_kg);
}

// The kinematics of one geometry.
class Delta {
 public:
  using Geometry = DeltaGeometry;
  static constexpr std::size_t kJoints = 3;
  static constexpr bool kSlides = false;

  // The keys of [mechanism] in TOML.
  static std::span<const drivers::Binding<DeltaGeometry>> keys();

  explicit Delta(const DeltaGeometry& geometry);

  // Returns the pose for finite joint angles, rad. `seed_D` is a guess of the tool's position, m,
  // best that of the previous tick. It changes the time taken, and the answer by no more than 1e-12
  // m. The status is kPoseNotConverged if no position was found, with p_D the seed. The time is
  // bounded.
  [[nodiscard]] Pose forward(const Vec3& joints, const Vec3& seed_D) const;

  // Returns the joint angles, rad, for a tool position, m, in closed form, or nothing if it is out
  // of reach. For simulators and tests: it is not part of the tick and uses the C library's arc
  // functions.
  [[nodiscard]] std::optional<Vec3> inverse(const Vec3& p_D) const;

  // Returns the efforts that hold arms, rods and platform at a good `pose`, N m. `gravity_D` is in
  // m/s^2. The rods' centre of mass is taken halfway between elbow and platform hinge.
  [[nodiscard]] Vec3 gravity_effort(const Vec3& joints, const Pose& pose,
                                    const Vec3& gravity_D) const;

 private:
  // The rods of all legs at one position of the tool.
  struct Rods {
    // Row i is the unit vector along rod i, from elbow to platform.
    Mat3 direction_D;
    // The length that rod i would have to be longer, to first order.
    Vec3 excess_m;
    // The share of rod i in its leg's plane: positive unless it is folded back past its hinges.
    Vec3 reach;
  };

  // A tool position that fits the arms.
  struct Solution {
    Vec3 p_D;
    Mat3 rods_D;  // Rods::direction_D at p_D
  };

  // For each leg, in its frame: the vector from elbow to platform hinge for a tool at the origin.
  using Offsets = std::array<Vec3, 3>;
  using Arms = std::array<rendering::SineCosine, 3>;

  // Returns the vector in the frame of a leg: u outward along its azimuth, v across, w = z.
  [[nodiscard]] Vec3 in_leg_frame(std::size_t leg, const Vec3& v_D) const;
  // Returns the rods for a tool at p_D.
  [[nodiscard]] Rods rods(const Vec3& p_D, const Offsets& offset) const;
  // Finds the tool position by Newton's method from the seed; nothing if it does not converge.
  [[nodiscard]] std::optional<Solution> solve(const Offsets& offset, const Vec3& seed_D) const;
  // Solves from the seed and computes Jacobian and status.
  [[nodiscard]] Pose assemble(const Arms& arms, const Vec3& seed_D) const;

  DeltaGeometry geometry_;
  std::array<double, 3> azimuth_sine_{};
  std::array<double, 3> azimuth_cosine_{};
};

// Returns true if a weight is set.
bool has_weight(const DeltaGeometry& g);

// Checks every field. An error names the field after "mechanism.".
void check_geometry(RangeCheck& check, const DeltaGeometry& g);

}  // namespace tactus::firmware
