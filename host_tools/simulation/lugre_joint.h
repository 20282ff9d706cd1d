// Friction of one joint after the LuGre model (Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE TAC
// 40(3), 1995): bristles that bend before they slip, so break-away, hysteresis and stick-slip come
// out of one equation.
#pragma once

namespace tactus::host {

// Force stands for N at a prismatic joint and N m at a revolute one; length for m and rad.
struct LuGreParameters {
  double coulomb = 0.0;             // force while sliding, > 0, or 0 for a joint without friction
  double break_away = 0.0;          // force at rest, >= coulomb
  double stribeck_velocity = 1e-3;  // length/s, > 0: where sliding has taken over
  double bristle_stiffness = 0.0;   // force/length
  double bristle_damping =
      0.0;  // force s/length; passive if viscous >= bristle_damping (break_away/coulomb - 1)
  double viscous = 0.0;  // force s/length
};

// Holds the mean bend z of the bristles. The update is exact for a velocity that is constant over
// the step, so it is stable at any velocity and step, and |z| never exceeds break_away /
// bristle_stiffness.
class LuGreJoint {
 public:
  explicit LuGreJoint(const LuGreParameters& parameters);

  // Moves by velocity dt_s; returns the friction force that opposes the motion (same sign as the
  // velocity when sliding).
  double advance(double velocity, double dt_s);

  void release() { bend_ = 0.0; }
  [[nodiscard]] double bend() const { return bend_; }
  // J: what the bristles would give back.
  [[nodiscard]] double stored_energy_J() const {
    return 0.5 * parameters_.bristle_stiffness * bend_ * bend_;
  }

 private:
  LuGreParameters parameters_;
  double per_stribeck_velocity_;
  double per_stiffness_;
  double bend_ = 0.0;  // length
};

}  // namespace tactus::host
