// Keeps the ledger of what the hand gets from the device.
//
// The device answers the sample at x with the force f after its delay d and holds it for a tick, so
// the hand gets f_d . (x' - x) while the tool goes from x to x': f_d is the force of d before
// (safety/held_forces.h), with d = 0 that of the past tick. Of that, with c the share of the
// rendered force that the limits let through and r = sum r_s its parts by source:
//
//  source s   c (r_s + r_s') / 2 . (x' - x), of a force that follows the motion at once
//  coupling   that part of it which surfaces give that move by themselves; it is not contact's
//  safety     (f_d - (c r)_d) . (x' - x)
//  delay      the rest: ((c r)_d - c (r + r') / 2) . (x' - x). Of a spring K at the speed v it is
//             K v^2 T (T / 2 + d): for d = 0 the energy that a sampled wall makes (Colgate and
//             Schenkel 1997)
#pragma once

#include "firmware/configuration/controller_config.h"
#include "firmware/safety/energy_ledger.h"
#include "firmware/safety/held_forces.h"
#include "rendering/geometry/vector.h"
#include "rendering/state/state_archive.h"
#include "rendering/world/touch.h"

namespace tactus::firmware {

// Of one tick, J.
struct TickEnergy {
  double given_J = 0.0;    // to the hand, of all sources
  double passive_J = 0.0;  // of it, what has to be passive: without effects and coupling
  double way_m2 = 0.0;     // |x' - x|^2
  double contact_N = 0.0;  // rendered now, without friction, textures and effects
  double step_s = 0.0;
};

class EnergyAccount {
 public:
  // Without, the force of a tick acts at once.
  void configure(const ControllerConfig& config);

  // Activation: nothing is held, nothing given.
  void restart();

  // The tool has come to p_W and the touch is of there, `step_s` after the tick before. Finite.
  TickEnergy settle(const Vec3& p_W, const rendering::Touch& touch, double step_s);

  // What goes out in this tick, and stays until the next.
  void hold(const Vec3& force_W);
  [[nodiscard]] const Vec3& held_W() const { return held_.newest().all_W; }

  [[nodiscard]] const EnergyLedger& ledger_J() const { return ledger_J_; }

  // The source that has given most so far.
  [[nodiscard]] EnergySource most_giving() const;

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  double tick_s_ = 0.001;
  HeldForces held_;
  EnergyLedger ledger_J_{};
  rendering::ForceParts parts_;  // of the tick before, as rendered
  Vec3 rendered_W_ = Vec3::Zero();
  Vec3 p_W_ = Vec3::Zero();
  bool is_placed_ = false;
};

// The part of the rendered force that is largest, N, or safety if `added_W` is larger still.
EnergySource strongest_part(const rendering::Touch& touch, const Vec3& added_W);

}  // namespace tactus::firmware
