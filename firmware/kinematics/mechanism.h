// The mechanisms that the controller knows, behind one interface. Any thread; real time.
#pragma once

#include <cstddef>
#include <variant>

#include "firmware/kinematics/registered_mechanisms.h"

namespace tactus::firmware {

template <class... Forms>
std::variant<typename Forms::Geometry...> geometries_of(TypeList<Forms...>);

using MechanismGeometry = decltype(geometries_of(Mechanisms{}));

// Returns the number of joints, 1 to 3. The mechanism uses the first ones of a sample and a
// command.
std::size_t joint_count(const MechanismGeometry& geometry);

// Returns true if the joints slide, and their positions are in m; they turn otherwise.
bool slides(const MechanismGeometry& geometry);

// Returns true if a weight is set. Without weights the gravity effort is zero everywhere.
bool has_weight(const MechanismGeometry& geometry);

// Checks the ranges of all fields. An error names the field as in the geometry's struct, after
// "mechanism.".
void check_mechanism(RangeCheck& check, const MechanismGeometry& geometry);

// Calls visit(geometry, its keys) with the geometry's own struct.
template <class Visitor>
void visit_mechanism(MechanismGeometry& geometry, Visitor&& visit) {
  visit_number(Mechanisms{}, geometry.index(), [&]<class Form>(std::type_identity<Form> /*form*/) {
    if (auto* const own = std::get_if<typename Form::Geometry>(&geometry)) {
      visit(*own, Form::keys());
    }
  });
}

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
  Mechanisms::Variant form_;
};

}  // namespace tactus::firmware
