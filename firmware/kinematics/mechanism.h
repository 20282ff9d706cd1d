// The mechanisms that the controller knows, as a closed sum type: adding one is a new alternative
// here.
#pragma once

#include <cstddef>
#include <variant>

#include "firmware/kinematics/cartesian.h"
#include "firmware/kinematics/delta.h"
#include "firmware/kinematics/paddle.h"
#include "firmware/kinematics/pantograph.h"
#include "firmware/kinematics/serial_arm.h"

namespace tactus::firmware {

using MechanismGeometry = std::variant<CartesianGeometry, DeltaGeometry, PaddleGeometry,
                                       PantographGeometry, SerialArmGeometry>;

// 1 to 3: how many joints of a sample and a command it uses, from the first on.
std::size_t joint_count(const MechanismGeometry& geometry);

// Whether gravity pulls on it: without weights its gravity effort is zero everywhere.
bool has_weight(const MechanismGeometry& geometry);

class Mechanism {
 public:
  explicit Mechanism(const MechanismGeometry& geometry = CartesianGeometry{});

  // Joint positions (finite) to pose in frame D; `seed_D` is a guess of the tool's position for the
  // mechanisms that iterate.
  [[nodiscard]] Pose forward(const Vec3& joints, const Vec3& seed_D) const;

  // The efforts that hold the mechanism's own weights up at a good `pose` of these joints: dU/dq.
  // Gravity in m/s^2, the direction in which things fall. Zero for joints that there are not.
  [[nodiscard]] Vec3 gravity_effort(const Vec3& joints, const Pose& pose,
                                    const Vec3& gravity_D) const;

 private:
  std::variant<CartesianGeometry, Delta, PaddleGeometry, Pantograph, SerialArm> form_;
};

}  // namespace tactus::firmware
