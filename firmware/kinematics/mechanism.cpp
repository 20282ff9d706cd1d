#include "firmware/kinematics/mechanism.h"

namespace tactus::firmware {
namespace {

Mechanisms::Variant form_of(const MechanismGeometry& geometry) {
  return visit_number(Mechanisms{}, geometry.index(),
                      [&]<class Form>(std::type_identity<Form> /*form*/) -> Mechanisms::Variant {
                        const auto* const own = std::get_if<typename Form::Geometry>(&geometry);
                        return Form(own != nullptr ? *own : typename Form::Geometry{});
                      });
}

}  // namespace

std::size_t joint_count(const MechanismGeometry& geometry) {
  return visit_number(Mechanisms{}, geometry.index(),
                      []<class Form>(std::type_identity<Form> /*form*/) { return Form::kJoints; });
}

bool slides(const MechanismGeometry& geometry) {
  return visit_number(Mechanisms{}, geometry.index(),
                      []<class Form>(std::type_identity<Form> /*form*/) { return Form::kSlides; });
}

bool has_weight(const MechanismGeometry& geometry) {
  return visit_alternative(geometry, [](const auto& own) { return has_weight(own); });
}

void check_mechanism(RangeCheck& check, const MechanismGeometry& geometry) {
  visit_alternative(geometry, [&](const auto& own) { check_geometry(check, own); });
}

Mechanism::Mechanism(const MechanismGeometry& geometry) : form_(form_of(geometry)) {}

Pose Mechanism::forward(const Vec3& joints, const Vec3& seed_D) const {
  return visit_alternative(form_, [&](const auto& form) { return form.forward(joints, seed_D); });
}

Vec3 Mechanism::gravity_effort(const Vec3& joints, const Pose& pose, const Vec3& gravity_D) const {
  return visit_alternative(
      form_, [&](const auto& form) { return form.gravity_effort(joints, pose, gravity_D); });
}

}  // namespace tactus::firmware
