// The five-bar pantograph of the Haply: two motors on the base, two links each, joined at the tool.
// Pure functions of the geometry for any thread; real time, except `inverse`.
//
// Frame D: origin on the first motor's axis, the second at +x; the linkage lies flat in the plane y
// = 0, x right, z toward the user. Joint i is the angle (rad) of motor i's proximal link from +x
// toward +z. The bearings take a force across the plane: it needs no effort. pantograph.cpp derives
// the equations.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "drivers/common/setting.h"
#include "firmware/kinematics/link_weight.h"
#include "firmware/kinematics/pose.h"
#include "firmware/kinematics/range_check.h"

namespace tactus::firmware {

// The dimensions of a pantograph, lengths in m. The defaults are the Haply development kit's.
struct PantographGeometry {
  // The distance from one motor axis to the other, m.
  double base_m = 0.02;
  // The length of a proximal link: the distance from its motor axis to its elbow, m.
  double proximal_m = 0.05;
  // The length of a distal link: the distance from its elbow to the tool, m.
  double distal_m = 0.07;
  // The weight of each of the two proximal links, from the motor axis.
  LinkWeight proximal;
  // The weight of each of the two distal links, from the elbow.
  LinkWeight distal;
  double tool_kg = 0.0;
};

inline void transfer(rendering::StateArchive& archive, PantographGeometry& geometry) {
  auto& [base_m, proximal_m, distal_m, proximal, distal, tool_kg] = geometry;
  archive(base_m, proximal_m, distal_m, proximal, distal, tool_kg);
}

using PantographJoints = std::array<double, 2>;

// The kinematics of one geometry.
class Pantograph {
 public:
  using Geometry = PantographGeometry;
  static constexpr std::size_t kJoints = 2;
  static constexpr bool kSlides = false;

  // The keys of [mechanism] in TOML.
  static std::span<const drivers::Binding<PantographGeometry>> keys();

  explicit Pantograph(const PantographGeometry& geometry) : geometry_(geometry) {}

  // Returns the pose in closed form. Two assemblies are possible; it takes the one with the tool to
  // the left of the line from the first elbow to the second (drawn with x right and z up): the one
  // farther from the base while the links do not cross. If the elbows are too far apart or
  // coincide, the status is kPoseNotConverged and p_D is the seed.
  [[nodiscard]] Pose forward(const Vec3& joints, const Vec3& seed_D) const;

  // Returns the joints of the assembly with both elbows outward, rad, or nothing if the tool is out
  // of reach. It ignores the distance from the plane. For simulators and tests, not for the tick.
  [[nodiscard]] std::optional<PantographJoints> inverse(const Vec3& p_D) const;

  // Returns the efforts that hold the links at a good `pose`, N m. `gravity_D` is in m/s^2.
  [[nodiscard]] Vec3 gravity_effort(const Vec3& joints, const Pose& pose,
                                    const Vec3& gravity_D) const;

 private:
  PantographGeometry geometry_;
};

// Returns true if a weight is set.
bool has_weight(const PantographGeometry& g);

// Checks every field. An error names the field after "mechanism.".
void check_geometry(RangeCheck& check, const PantographGeometry& g);

}  // namespace tactus::firmware
