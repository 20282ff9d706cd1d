// The mechanisms that the controller knows, as a closed sum type: adding one is a new alternative
// here.
#pragma once

#include <variant>

#include "firmware/kinematics/cartesian.h"
#include "firmware/kinematics/delta.h"

namespace tactus::firmware {

using MechanismGeometry = std::variant<CartesianGeometry, DeltaGeometry>;

class Mechanism {
 public:
  explicit Mechanism(const MechanismGeometry& geometry = CartesianGeometry{}) {
    if (const auto* delta = std::get_if<DeltaGeometry>(&geometry)) {
      form_.emplace<Delta>(*delta);
    }
  }

  // Joint positions (finite) to pose in frame D; `seed_D` is a guess of the tool's position for the
  // mechanisms that iterate.
  [[nodiscard]] Pose forward(const Vec3& joints, const Vec3& seed_D) const {
    if (const auto* delta = std::get_if<Delta>(&form_)) {
      return delta->forward(joints, seed_D);
    }
    return cartesian_forward(joints);
  }

 private:
  struct Cartesian {};
  std::variant<Cartesian, Delta> form_;
};

}  // namespace tactus::firmware
