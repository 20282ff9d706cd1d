// Keeps the ledger of the energy that the device gives to the hand. One thread; real time.
//
// The device answers the sample at x with the force f after its delay d, and holds it for a tick.
// While the tool goes from x to x', the force f_d of the time d before acts on it
// (safety/held_forces.h); for d = 0 that is the force of the past tick. The hand gets f_d . (x' -
// x). This energy is divided among the sources. r = sum r_s is the rendered force with its parts by
// source, a prime marks the values of this tick, and c is the share of r that the limits let
// through:
//
//   source s   c (r_s + r_s') / 2 . (x' - x): the energy of a force that follows the motion at once
//   coupling   the part of it which surfaces give that move by themselves; it is not contact's
//   safety     (f_d - (c r)_d) . (x' - x)
//   delay      the rest: ((c r)_d - c (r + r') / 2) . (x' - x). For a spring K at the speed v it is
//              K v^2 T (T / 2 + d): for d = 0 the energy that a sampled wall makes (Colgate and
//              Schenkel 1997)
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
  // The energy given to the hand by all sources, J; negative if the hand gave it.
  double given_J = 0.0;
  // The part of it that has to be passive: without effects and coupling.
  double passive_J = 0.0;
  // The squared length of the tool's motion, |x' - x|^2, m^2.
  double way_m2 = 0.0;
  // The contact force that is rendered now, N, without friction, textures and effects.
  double contact_N = 0.0;
  // The length of the tick, s, with the ticks missed before it.
  double step_s = 0.001;
};

// The ledger of one tool.
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
  // Returns the force that went out in the last tick, N.
  [[nodiscard]] const Vec3& held_W() const { return held_.newest().all_W; }

  // Returns the energy given since activation, J, by source.
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
  // The rendered force, N, and the tool's position, m, of the previous tick.
  Vec3 rendered_W_ = Vec3::Zero();
  Vec3 p_W_ = Vec3::Zero();
  bool is_placed_ = false;
};

// Returns the source with the largest part of the rendered force, or safety if `added_W` (N) is
// larger.
EnergySource strongest_part(const rendering::Touch& touch, const Vec3& added_W);

}  // namespace tactus::firmware
