// A mass on a surface with friction, pushed by a force or pulled by a spring: the set-up of the
// published experiments.
//   m dv/dt = u + k (y - x) - F
// A step solves motion and friction together, for the displacement d that satisfies
//   2 m (d - v0 T) / T^2 = u + k (y - x0 - d / 2) - F(d),
// the midpoint rule with F as the model's own mean over the step. It is of second order and stable
// at any stiffness, and the energies balance to rounding. If several d satisfy it, the one nearest
// to v0 T is taken. A rigid model (no stiffness) that can hold the mass holds it: then d = 0 and v
// = 0.
#pragma once

#include "rendering/friction/friction_model.h"

namespace tactus::host {

// The mass, its spring and its friction. `friction` must be valid, `mass_kg` above 0, the others 0
// or more.
struct SlidingMassParameters {
  rendering::FrictionParameters friction;
  double mass_kg = 1.0;
  // The stiffness of the spring between the mass and `spring_end_m`; 0: there is none.
  double spring_N_per_m = 0.0;
  double normal_force_N = 1.0;
};

// The load on the mass in a step, by its values in the middle of the step.
struct Drive {
  // A force on the mass in the direction of x.
  double push_N = 0.0;
  // The position y of the spring's other end.
  double spring_end_m = 0.0;
};

// The mass after a step.
struct SlidingMassState {
  double time_s = 0.0;
  double x_m = 0.0;
  double v_m_per_s = 0.0;
  // The friction of the last step; it acts against the motion.
  rendering::FrictionForce<double> friction;
};

// The mass. One thread.
class SlidingMass {
 public:
  explicit SlidingMass(const SlidingMassParameters& parameters) : parameters_(parameters) {}

  // Starts over at time 0 with relaxed bristles.
  void place(double x_m, double v_m_per_s);
  // Advances by `step_s`, which must be above 0; the drive must be finite.
  const SlidingMassState& step(const Drive& drive, double step_s);

  // Returns the state after the last step.
  [[nodiscard]] const SlidingMassState& state() const { return state_; }
  // Returns the energy of the mass and the bristle, without that of the spring.
  [[nodiscard]] double energy_J() const;

 private:
  [[nodiscard]] double excess_N(double displacement_m, double supply_N, double step_s) const;
  // Returns the displacement that satisfies the equation above.
  [[nodiscard]] double solve(double supply_N, double step_s) const;
  // Holds the mass if rigid friction can; returns false otherwise.
  bool hold(double supply_N, double step_s);

  SlidingMassParameters parameters_;
  SlidingMassState state_;
  rendering::FrictionMemory<double> bristle_;
};

}  // namespace tactus::host
