// The mechanisms that the controller knows, behind one interface. Any thread; real time.
#pragma once

#include <cstddef>
#include <variant>

#include "firmware/kinematics/cartesian.h"
#include "firmware/kinematics/delta.h"
#include "firmware/kinematics/paddle.h"
#include "firmware/kinematics/pantograph.h"
#include "firmware/kinematics/serial_arm.h"

namespace tactus::firmware {

// The dimensions and weights of a mechanism. A new mechanism is a new alternative here.
using MechanismGeometry = std::variant<CartesianGeometry, DeltaGeometry, PaddleGeometry,
                                       PantographGeometry, SerialArmGeometry>;

// Returns the number of joints, 1 to 3. The mechanism uses the first ones of a sample and a
// command.
std::size_t joint_count(const MechanismGeometry& geometry);

// Returns true if a weight is set. Without weights the gravity effort is zero everywhere.
bool has_weight(const MechanismGeometry& geometry);

// The kinematics of the configured mechanism.
class Mechanism {
 public:
  explicit Mechanism(const MechanismGeometry& geometry = CartesianGeometry{});

  // Returns the pose in frame D for finite joint positions, rad or m. `seed_D` is a guess of the
  // tool's position, m, for mechanisms that iterate. The time is bounded.
  [[nodiscard]] Pose forward(const Vec3& joints, const Vec3& seed_D) const;

  // Returns the efforts dU/dq that hold the mechanism's own weights at a good `pose` of these
  // joints, N m or N. `gravity_D` is in m/s^2, in the direction in which things fall. The efforts
  // of joints beyond the mechanism's are zero.
  [[nodiscard]] Vec3 gravity_effort(const Vec3& joints, const Pose& pose,
                                    const Vec3& gravity_D) const;

 private:
  std::variant<CartesianGeometry, Delta, PaddleGeometry, Pantograph, SerialArm> form_;
};

}  // namespace tactus::firmware
