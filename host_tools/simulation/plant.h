// The mechanics of the simulated device with a hand on its handle. SimulatedDevice advances it in
// sub-steps between two ticks of the controller.
//
// The handle is one point mass m (device and hand) in the device's base frame B, x right, y up, z
// toward the user:
//   m dv/dt = sum_i row_i (effort_i - friction_i) - b v + k (w - p) + c (dw/dt - v) + s + g
// row_i is the mechanism's row of joint i, b the device's viscous damping, k and c the hand's
// spring and damper, w its wish, s the force of the end stops, g the weight of the links, which
// acts as masses at the elbows and at the handle. The linear part is integrated by the implicit
// midpoint rule, which neither creates nor dissipates energy in the spring; joint friction, stops
// and weights are evaluated at the start of a step. A mechanism with fewer than three joints keeps
// the handle on its plane or arc, without friction.
#pragma once

#include <array>
#include <cstddef>

#include "host_tools/simulation/joint_friction.h"
#include "host_tools/simulation/plant_mechanism.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

// The effort of each joint: N m, or N for a linear joint.
using JointEfforts = std::array<double, kPlantJoints>;

// The mechanics of a device.
struct PlantParameters {
  PlantMechanism mechanism = CartesianAxes{};
  // The device's mass as felt at the handle.
  double moving_mass_kg = 0.1;
  // Damping at the handle, alike in all directions.
  double viscous_Ns_per_m = 0.5;
  // The friction of every joint, in the joint's own units (joint_friction.h).
  rendering::FrictionParameters joint_friction;
  // Mechanical end stops: a box in B, m, whose walls are springs with dampers.
  Vec3 stop_lower_B = Vec3::Constant(-0.1);
  Vec3 stop_upper_B = Vec3::Constant(0.1);
  double stop_stiffness_N_per_m = 20e3;
  double stop_damping_Ns_per_m = 20.0;
  // The weights on the mechanism. A link of mass m whose centre lies at the share s of its length
  // puts m (1 - s) on its inner end and m s on its outer end. This one hangs at each elbow. Both 0:
  // the device is balanced.
  double elbow_kg = 0.0;
  // The weight at the handle.
  double handle_kg = 0.0;
  // Gravity, m/s^2, in B.
  Vec3 gravity_B = {0.0, -9.80665, 0.0};
};

// The hand on the handle during one step; all zero means that no hand holds it.
struct Grip {
  double mass_kg = 0.0;
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  // The wished position in the middle of the step, m.
  Vec3 wish_p_B = Vec3::Zero();
  // The velocity of the wished position, m/s.
  Vec3 wish_v_B = Vec3::Zero();
};

// The work done on the handle since place(), J. Its kinetic energy changes by exactly the sum of
// the five, so the sum is a test of the integrator.
struct EnergyLedger {
  // By the motors, through the mechanism.
  double motors_J = 0.0;
  // By the hand's spring and damper.
  double hand_J = 0.0;
  // By the viscous damping; never positive.
  double viscous_J = 0.0;
  // By joint friction and end stops, which may give back stored energy.
  double friction_and_stops_J = 0.0;
  // By the weight of the links.
  double weight_J = 0.0;
};

// The state of the mechanics. One thread; no heap.
class Plant {
 public:
  // Places the handle at rest at the origin of B.
  explicit Plant(const PlantParameters& parameters);

  // Places the handle at rest at `p_B`, m, or at the nearest point that the mechanism permits;
  // relaxes the bristles and clears the ledger.
  void place(const Vec3& p_B);
  // Advances by `dt_s` with constant efforts (N m or N).
  void step(const JointEfforts& effort, const Grip& grip, double dt_s);

  // The handle's position, m, and velocity, m/s.
  [[nodiscard]] const Vec3& p_B() const { return p_B_; }
  [[nodiscard]] const Vec3& v_B() const { return v_B_; }
  // The joints' coordinates and rows at the handle's position.
  [[nodiscard]] const MechanismPose& pose() const { return pose_; }
  // The work since the last place().
  [[nodiscard]] const EnergyLedger& ledger() const { return ledger_; }
  // Returns the elastic energy of the joints' bristles and the end stops, J.
  [[nodiscard]] double stored_energy_J() const;
  // Returns the potential energy of the weights, J, up to a constant.
  [[nodiscard]] double potential_J() const;

 private:
  // Returns the force of the end stops at the present state, N.
  [[nodiscard]] Vec3 stop_force() const;
  // Returns the force on the handle from the weights on the mechanism, N.
  [[nodiscard]] Vec3 weight_force() const;
  // Moves the handle by a step at its mean velocity and back onto the manifold; sets its velocity
  // and pose.
  void move(const Vec3& mean_v_B, double dt_s);

  PlantParameters parameters_;
  std::array<JointFriction, kPlantJoints> joints_;
  Vec3 p_B_ = Vec3::Zero();
  Vec3 v_B_ = Vec3::Zero();
  MechanismPose pose_;
  EnergyLedger ledger_;
};

}  // namespace tactus::host
