// The dimensions of the simulated mechanisms. They are structs of their own, so that the simulation
// shares nothing with the controller's kinematics but the numbers of a device file
// (described_device.h). All use the base frame B: x right, y up, z from the base toward the user.
// Lengths are in m.
#pragma once

#include <array>
#include <cstddef>
#include <variant>

#include "rendering/geometry/vector.h"

namespace tactus::host {

// The largest number of joints of a mechanism.
inline constexpr std::size_t kPlantJoints = 3;

// Three linear joints along the axes of B; a joint's position is the handle's coordinate.
struct CartesianAxes {
  // The mass that moves with each axis, for each kg of PlantParameters::elbow_kg.
  std::array<double, kPlantJoints> carried_kg{};

  bool operator==(const CartesianAxes&) const = default;
};

// The direction of a leg of a delta about z, from x toward y.
struct LegAzimuth {
  double cos = 1.0;
  double sin = 0.0;

  bool operator==(const LegAzimuth&) const = default;
};

// A delta with three revolute shoulders. The defaults are those of the Novint Falcon.
struct DeltaLengths {
  // The upper arm, from the shoulder to the elbow.
  double arm_m = 0.060;
  // The parallelogram, and both of its end pieces together.
  double rod_m = 0.1025;
  double end_pieces_m = 0.0225;
  // The distance from the handle to the platform's joint, along the leg's azimuth and across it.
  double platform_m = 0.01443;
  double platform_across_m = -0.025;
  // The distance from the base's axis to the shoulder, along the leg's azimuth and across it.
  double base_m = 0.0400;
  double base_across_m = -0.02309;
  // 105, -15 and -135 degrees.
  std::array<LegAzimuth, kPlantJoints> legs{{
      {.cos = -0.25881904510252074, .sin = 0.9659258262890683},
      {.cos = 0.9659258262890683, .sin = -0.25881904510252074},
      {.cos = -0.7071067811865476, .sin = -0.7071067811865476},
  }};

  bool operator==(const DeltaLengths&) const = default;
};

// One paddle about z: the handle moves on an arc and is straight up at 0. The default is the
// Hapkit's.
struct PaddleLengths {
  // The distance from the axis to the handle.
  double radius_m = 0.065659;

  bool operator==(const PaddleLengths&) const = default;
};

// A five-bar linkage of two motors, flat in the plane y = 0, the first motor at the origin and the
// second at +x. The defaults are those of the Haply.
struct PantographLengths {
  // The distance between the motors.
  double base_m = 0.02;
  // The link from a motor to its elbow.
  double proximal_m = 0.05;
  // The link from an elbow to the handle.
  double distal_m = 0.07;

  bool operator==(const PantographLengths&) const = default;
};

// A serial arm: azimuth, upper arm from level, forearm from hanging.
struct ArmLengths {
  // The distance from the shoulder to the elbow.
  double upper_m = 0.0;
  // The distance from the elbow to the handle.
  double forearm_m = 0.0;
  // The height of the shoulder above the base frame's origin.
  double shoulder_m = 0.0;

  bool operator==(const ArmLengths&) const = default;
};
inline constexpr ArmLengths kPhantomLengths{.upper_m = 0.209550, .forearm_m = 0.169545};
inline constexpr ArmLengths kWoodenLengths{
    .upper_m = 0.205, .forearm_m = 0.245, .shoulder_m = 0.080};

// A mechanism with its dimensions.
using PlantMechanism =
    std::variant<CartesianAxes, DeltaLengths, PaddleLengths, PantographLengths, ArmLengths>;

}  // namespace tactus::host
