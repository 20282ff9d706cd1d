// Keeps the ledger of the energy that the device gives to the hand.
//
// The device answers the sample at x with the force f after its delay d and holds it for a tick, so
// the hand gets f_d . (x' - x) while the tool goes from x to x': f_d is the force of d before
// (safety/held_forces.h), with d = 0 that of the past tick. That energy has these parts, with c the
// share of the rendered force that the limits let through and r = sum r_s its parts by source:
//
//  source s   c (r_s + r_s') / 2 . (x' - x), of a force that follows the motion at once
//  coupling   that part of it which surfaces give that move by themselves; it is not contact's
//  safety     (f_d - (c r)_d) . (x' - x)
//  delay      the rest: ((c r)_d - c (r + r') / 2) . (x' - x). For a spring K at the speed v it is
//             K v^2 T (T / 2 + d): for d = 0 the energy that a sampled wall makes (Colgate and
//             Schenkel 1997)
#pragma once

#include "firmware/configuration/controller_config.h"
#include "firmware/safety/energy_ledger.h"
#include "firmware/safety/held_forces.h"
#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"
#include "rendering/touch.h"

namespace tactus::firmware {

// The energy of one tick.
struct TickEnergy {
  double given_J = 0.0;    // given to the hand by all sources
  double passive_J = 0.0;  // the part that has to be passive: without effects and coupling
  double way_m2 = 0.0;     // squared length of the tool's motion, |x' - x|^2, m^2
  double contact_N = 0.0;  // contact force rendered now, without friction, textures and effects
  double step_s = 0.0;     // length of the tick
};

class EnergyAccount {
 public:
  // Takes the rate and the device's delay. Before the first call, a force acts without delay.
  void configure(const ControllerConfig& config);

  // Clears the ledger and the held forces. Call at activation.
  void restart();

  // Adds the energy of the tool's motion to p_W, where `touch` was computed, `step_s` after the
  // previous tick. All must be finite. Returns the energy of this tick.
  TickEnergy settle(const Vec3& p_W, const rendering::Touch& touch, double step_s);

  // Sets the force that goes out in this tick and is held until the next, N.
  void hold(const Vec3& force_W);
  [[nodiscard]] const Vec3& held_W() const { return held_.newest().all_W; }

  [[nodiscard]] const EnergyLedger& ledger_J() const { return ledger_J_; }

  // Returns the source that has given most energy so far.
  [[nodiscard]] EnergySource most_giving() const;

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  double tick_s_ = 0.001;
  HeldForces held_;
  EnergyLedger ledger_J_{};
  rendering::ForceParts parts_;  // the rendered force of the previous tick, by source
  Vec3 rendered_W_ = Vec3::Zero();
  Vec3 p_W_ = Vec3::Zero();
  bool is_placed_ = false;
};

// Returns the source with the largest part of the rendered force, or safety if `added_W` (N) is
// larger.
EnergySource strongest_part(const rendering::Touch& touch, const Vec3& added_W);

}  // namespace tactus::firmware
