// The simulated device's geometry: how motions of the handle turn the joints. Written from the fact
// sheet's closed form (a position gives its joints), on purpose not the controller's kinematics, so
// that an error in either shows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/geometry/vector.h"

namespace tactus::host {

inline constexpr std::size_t kPlantJoints = 3;

enum class MechanismKind : std::uint8_t {
  cartesian,     // three prismatic joints along the base's axes: joint = handle position
  falcon_delta,  // Novint Falcon: three revolute shoulders of a delta
};

// Row i: how fast joint i turns per m/s of the handle. Joint speeds are rows . v; by virtual work
// the handle feels sum_i row_i effort_i. Base frame B: x right, y up, z from the base toward the
// user.
using JointRateRows = std::array<Vec3, kPlantJoints>;

struct MechanismPose {
  JointRateRows rows{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  // tan(half the shoulder angle) for the delta, the position itself (m) for Cartesian;
  // `joint_position` reads it.
  std::array<double, kPlantJoints> coordinate{};
  bool reachable = true;  // false where the delta's legs do not reach; the rows then stay finite
};

// No transcendental functions: it runs at every sub-step.
void solve_mechanism(MechanismKind kind, const Vec3& p_B, MechanismPose& pose);

// rad for the delta (0 is an arm along the base plane, positive lifts), m for Cartesian.
double joint_position(MechanismKind kind, double coordinate);

}  // namespace tactus::host
