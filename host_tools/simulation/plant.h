// The mechanics of the simulated device with a hand on its handle, between two ticks of the
// controller.
//
// The handle is a point mass, device and hand together, in the device's base frame B (x right, y
// up, z toward the user):
//   m dv/dt = sum_i row_i (effort_i - friction_i) - b v + k (w - p) + c (dw/dt - v) + stops
// with the mechanism's rows, friction in every joint, the device's viscous damping b and the
// hand's spring k and damper c to the wish w, and the weight of the mechanism's links, if it has
// any: their potential is that of masses at the elbows and at the handle. The linear part is
// integrated with the implicit midpoint rule, which neither makes nor loses energy in the spring;
// joint friction, stops and weights are taken at the step's start. A mechanism with fewer than
// three joints holds the handle on its plane or arc, without friction.
#pragma once

#include <array>
#include <cstddef>

#include "host_tools/simulation/joint_friction.h"
#include "host_tools/simulation/plant_mechanism.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

using JointEfforts = std::array<double, kPlantJoints>;  // N m or N

struct PlantParameters {
  MechanismKind mechanism = MechanismKind::cartesian;
  double moving_mass_kg = 0.1;
  double viscous_Ns_per_m = 0.5;
  rendering::FrictionParameters joint_friction;
  // Mechanical end stops: a box in B with springy, damped walls.
  Vec3 stop_lower_B = Vec3::Constant(-0.1);  // m
  Vec3 stop_upper_B = Vec3::Constant(0.1);   // m
  double stop_stiffness_N_per_m = 20e3;
  double stop_damping_Ns_per_m = 20.0;
  // What hangs on the mechanism. A link of mass m whose centre lies at the share s of its length
  // puts m (1 - s) on its inner end and m s on its outer one. All zero: as if balanced.
  double elbow_kg = 0.0;                  // at each elbow
  double handle_kg = 0.0;                 // at the handle
  Vec3 gravity_B = {0.0, -9.80665, 0.0};  // m/s^2
};

// The hand on the handle during one step; all zero is no hand.
struct Grip {
  double mass_kg = 0.0;
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  Vec3 wish_p_B = Vec3::Zero();  // m, in the middle of the step
  Vec3 wish_v_B = Vec3::Zero();  // m/s
};

// Work since `place`, J. The handle's kinetic energy changes by exactly the sum of the five.
struct EnergyLedger {
  double motors_J = 0.0;              // on the handle, through the mechanism
  double hand_J = 0.0;                // spring and damper of the hand on the handle
  double viscous_J = 0.0;             // never positive
  double friction_and_stops_J = 0.0;  // joint friction and end stops; stored energy may come back
  double weight_J = 0.0;
};

class Plant {
 public:
  explicit Plant(const PlantParameters& parameters);

  // At rest at p_B, bristles relaxed, ledger cleared.
  void place(const Vec3& p_B);
  void step(const JointEfforts& effort, const Grip& grip, double dt_s);

  [[nodiscard]] const Vec3& p_B() const { return p_B_; }
  [[nodiscard]] const Vec3& v_B() const { return v_B_; }
  [[nodiscard]] const MechanismPose& pose() const { return pose_; }
  [[nodiscard]] const EnergyLedger& ledger() const { return ledger_; }
  // Joint friction's bristles and the end stops' springs.
  [[nodiscard]] double stored_energy_J() const;
  // Of the weights, up to a constant.
  [[nodiscard]] double potential_J() const;

 private:
  [[nodiscard]] Vec3 stop_force() const;
  [[nodiscard]] Vec3 weight_force() const;
  void move(const Vec3& mean_v_B, double dt_s);

  PlantParameters parameters_;
  std::array<JointFriction, kPlantJoints> joints_;
  Vec3 p_B_ = Vec3::Zero();
  Vec3 v_B_ = Vec3::Zero();
  MechanismPose pose_;
  EnergyLedger ledger_;
};

}  // namespace tactus::host
