// The functions use get_if because std::visit needs exceptions.
#include "firmware/kinematics/mechanism.h"

namespace tactus::firmware {

std::size_t joint_count(const MechanismGeometry& geometry) {
  if (std::holds_alternative<PaddleGeometry>(geometry)) {
    return 1;
  }
  return std::holds_alternative<PantographGeometry>(geometry) ? 2 : 3;
}

bool has_weight(const MechanismGeometry& geometry) {
  if (const auto* cartesian = std::get_if<CartesianGeometry>(&geometry)) {
    return has_weight(*cartesian);
  }
  if (const auto* delta = std::get_if<DeltaGeometry>(&geometry)) {
    return has_weight(*delta);
  }
  if (const auto* paddle = std::get_if<PaddleGeometry>(&geometry)) {
    return has_weight(*paddle);
  }
  if (const auto* pantograph = std::get_if<PantographGeometry>(&geometry)) {
    return has_weight(*pantograph);
  }
  const auto* arm = std::get_if<SerialArmGeometry>(&geometry);
  return arm != nullptr && has_weight(*arm);
}

Mechanism::Mechanism(const MechanismGeometry& geometry) {
  if (const auto* cartesian = std::get_if<CartesianGeometry>(&geometry)) {
    form_.emplace<CartesianGeometry>(*cartesian);
  } else if (const auto* delta = std::get_if<DeltaGeometry>(&geometry)) {
    form_.emplace<Delta>(*delta);
  } else if (const auto* paddle = std::get_if<PaddleGeometry>(&geometry)) {
    form_.emplace<PaddleGeometry>(*paddle);
  } else if (const auto* pantograph = std::get_if<PantographGeometry>(&geometry)) {
    form_.emplace<Pantograph>(*pantograph);
  } else if (const auto* arm = std::get_if<SerialArmGeometry>(&geometry)) {
    form_.emplace<SerialArm>(*arm);
  }
}

Pose Mechanism::forward(const Vec3& joints, const Vec3& seed_D) const {
  if (const auto* delta = std::get_if<Delta>(&form_)) {
    return delta->forward(joints, seed_D);
  }
  if (const auto* paddle = std::get_if<PaddleGeometry>(&form_)) {
    return paddle_forward(*paddle, joints.x());
  }
  if (const auto* pantograph = std::get_if<Pantograph>(&form_)) {
    return pantograph->forward(joints, seed_D);
  }
  if (const auto* arm = std::get_if<SerialArm>(&form_)) {
    return arm->forward(joints);
  }
  return cartesian_forward(joints);
}

Vec3 Mechanism::gravity_effort(const Vec3& joints, const Pose& pose, const Vec3& gravity_D) const {
  if (const auto* delta = std::get_if<Delta>(&form_)) {
    return delta->gravity_effort(joints, pose, gravity_D);
  }
  if (const auto* paddle = std::get_if<PaddleGeometry>(&form_)) {
    return {paddle_gravity_effort(*paddle, pose, gravity_D), 0.0, 0.0};
  }
  if (const auto* pantograph = std::get_if<Pantograph>(&form_)) {
    return pantograph->gravity_effort(joints, pose, gravity_D);
  }
  if (const auto* arm = std::get_if<SerialArm>(&form_)) {
    return arm->gravity_effort(joints, gravity_D);
  }
  const auto* cartesian = std::get_if<CartesianGeometry>(&form_);
  return cartesian != nullptr ? cartesian_gravity_effort(*cartesian, gravity_D)
                              : Vec3(Vec3::Zero());
}

}  // namespace tactus::firmware
