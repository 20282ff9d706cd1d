// Three prismatic joints along x, y and z of frame D: the joint positions, m, are the tool's
// position. Pure functions for any thread; real time.
#pragma once

#include <array>
#include <span>

#include "drivers/common/setting.h"
#include "firmware/kinematics/pose.h"
#include "firmware/kinematics/range_check.h"

namespace tactus::firmware {

// The weights of the three axes.
struct CartesianGeometry {
  // The mass that moves with each axis, kg, together with the axes that it carries.
  std::array<double, 3> carried_kg{};
};

inline void transfer(rendering::StateArchive& archive, CartesianGeometry& geometry) {
  auto& [carried_kg] = geometry;
  archive(carried_kg);
}

// Returns the pose, which is never singular.
inline Pose cartesian_forward(const Vec3& joints) {
  return {joints, Mat3::Identity(), kPoseGood};
}

// Returns true if a mass is set.
inline bool has_weight(const CartesianGeometry& g) {
  return g.carried_kg != std::array<double, 3>{};
}

// Returns the efforts that hold the axes, N. `gravity_D` is in m/s^2.
inline Vec3 cartesian_gravity_effort(const CartesianGeometry& g, const Vec3& gravity_D) {
  const Vec3 carried_kg(g.carried_kg[0], g.carried_kg[1], g.carried_kg[2]);
  return -carried_kg.cwiseProduct(gravity_D);
}

// Checks every field. An error names the field after "mechanism.".
void check_geometry(RangeCheck& check, const CartesianGeometry& g);

class Cartesian {
 public:
  using Geometry = CartesianGeometry;
  static constexpr std::size_t kJoints = 3;
  static constexpr bool kSlides = true;

  // The keys of [mechanism] in TOML.
  static std::span<const drivers::Binding<CartesianGeometry>> keys();

  explicit Cartesian(const CartesianGeometry& geometry) : geometry_(geometry) {}

  [[nodiscard]] Pose forward(const Vec3& joints, const Vec3& /*seed_D*/) const {
    return cartesian_forward(joints);
  }
  [[nodiscard]] Vec3 gravity_effort(const Vec3& /*joints*/, const Pose& /*pose*/,
                                    const Vec3& gravity_D) const {
    return cartesian_gravity_effort(geometry_, gravity_D);
  }

 private:
  CartesianGeometry geometry_;
};

}  // namespace tactus::firmware
