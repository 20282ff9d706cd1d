// The three-arm delta of the Novint Falcon.
//
// Three arms turn on the base, each joined to the grip's platform by a parallelogram of rods, so
// that the platform only translates. Frame D: origin on the base's axis at the height of the motor
// axes, x right, y up, z from the base toward the user. Joint i is arm i's angle from the base
// plane, growing toward the user; arms are top, right, left as the user sees them.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <span>

#include "drivers/common/setting.h"
#include "firmware/kinematics/link_weight.h"
#include "firmware/kinematics/pose.h"
#include "firmware/kinematics/range_check.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::firmware {

// Lengths in m. The defaults are the Falcon's (R. E. Stamper's delta, with the figures of
// libnifalcon).
struct DeltaGeometry {
  double arm_m = 0.060;                // motor axis to elbow
  double rod_m = 0.1025;               // between the parallelogram's hinges
  double hinge_offset_m = 0.0225;      // elbow to rod hinge plus platform to rod hinge
  double base_radius_m = 0.0400;       // base axis to motor axis, along the arm's azimuth
  double base_tangent_m = -0.02309;    // base axis to motor axis, across the azimuth
  double platform_radius_m = 0.01443;  // tool to platform hinge, along the azimuth
  double platform_tangent_m = -0.025;  // tool to platform hinge, across the azimuth
  std::array<double, 3> azimuth_rad = {105.0 * std::numbers::pi / 180.0,
                                       -15.0 * std::numbers::pi / 180.0,
                                       -135.0 * std::numbers::pi / 180.0};
  double nominal_height_m = 0.12;  // z inside the workspace: Newton starts there without a seed
  LinkWeight arm;                  // of each arm, from the motor axis toward the elbow
  double rods_kg = 0.0;            // mass of the pair of rods of one leg
  double platform_kg = 0.0;        // mass of the platform with the grip
};

inline void transfer(rendering::StateArchive& archive, DeltaGeometry& geometry) {
  auto& [arm_m, rod_m, hinge_offset_m, base_radius_m, base_tangent_m, platform_radius_m,
         platform_tangent_m, azimuth_rad, nominal_height_m, arm, rods_kg, platform_kg] = geometry;
  archive(arm_m, rod_m, hinge_offset_m, base_radius_m, base_tangent_m, platform_radius_m,
          platform_tangent_m, azimuth_rad, nominal_height_m, arm, rods_kg, platform_kg);
}

class Delta {
 public:
  using Geometry = DeltaGeometry;
  static constexpr std::size_t kJoints = 3;
  static constexpr bool kSlides = false;

  // The keys of [mechanism] in TOML.
  static std::span<const drivers::Binding<DeltaGeometry>> keys();

  explicit Delta(const DeltaGeometry& geometry);

  // Returns the pose for finite joint angles, rad. `seed_D` is a guess of the tool's position, best
  // that of the previous tick. It changes the time taken, and the answer by no more than 1e-12 m.
  // The time is bounded.
  [[nodiscard]] Pose forward(const Vec3& joints, const Vec3& seed_D) const;

  // Returns the joint angles for a tool position in closed form, or nothing if it is out of reach.
  // For simulators and tests: it is not part of the tick and uses the C library's arc functions.
  [[nodiscard]] std::optional<Vec3> inverse(const Vec3& p_D) const;

  // Returns the efforts that hold arms, rods and platform at a good `pose`, N m. `gravity_D` is in
  // m/s^2. The rods' centre of mass is taken halfway between elbow and platform hinge.
  [[nodiscard]] Vec3 gravity_effort(const Vec3& joints, const Pose& pose,
                                    const Vec3& gravity_D) const;

 private:
  struct Rods {
    Mat3 direction_D;  // row i: unit vector along rod i, elbow to platform
    Vec3 excess_m;     // missing length of rod i, to first order
    Vec3 reach;  // share of rod i in its leg's plane: positive unless folded back past its hinges
  };

  struct Solution {
    Vec3 p_D;
    Mat3 rods_D;  // Rods::direction_D at p_D
  };

  // For each leg, in its frame: the vector from elbow to platform hinge for a tool at the origin.
  using Offsets = std::array<Vec3, 3>;
  using Arms = std::array<rendering::SineCosine, 3>;

  [[nodiscard]] Vec3 in_leg_frame(std::size_t leg, const Vec3& v_D) const;
  [[nodiscard]] Rods rods(const Vec3& p_D, const Offsets& offset) const;
  [[nodiscard]] std::optional<Solution> solve(const Offsets& offset, const Vec3& seed_D) const;
  [[nodiscard]] Pose assemble(const Arms& arms, const Vec3& seed_D) const;

  DeltaGeometry geometry_;
  std::array<double, 3> azimuth_sine_{};
  std::array<double, 3> azimuth_cosine_{};
};

bool has_weight(const DeltaGeometry& g);

// Checks every field. An error names the field after "mechanism.".
void check_geometry(RangeCheck& check, const DeltaGeometry& g);

}  // namespace tactus::firmware
