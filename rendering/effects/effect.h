// Forces that need no surface: fields, springs and signals, each bounded, and each with an account
// of the energy that it gave to the hand.
#pragma once

#include "rendering/effects/law.h"
#include "rendering/effects/registered_laws.h"

namespace tactus::rendering {

struct Effect {
  EffectLaw law;
  double max_force_N = 0.0;  // > 0; the force is never larger
};

// Returns true if the bound is above 0 and every field of the law is within its range
// (law_checks.h).
bool valid(const Effect& effect);

// Computes one tick: adds the energy of the tool's last step to the account, and returns the force
// on the hand (N, world frame). The effect must be valid, the tool finite, dt_s > 0. Real time: no
// heap, bounded time.
//
// If the force exceeds its bound the elastic part is cut first, and the damping uses the rest of
// the bound. So the elastic part stays conservative and the damping dissipative.
Vec3 apply(const Effect& effect, EffectState& state, const ToolState& tool, double dt_s);

// Returns the energy (J) that the effect's elastic part gives back on the path from p_W to the
// place where it stores the least: its anchor, target or pole, or infinity for a repelling magnet.
// Drag and vibration store none. A constant field has no such place; it counts from the origin, and
// can be negative.
//
// For every law but Vibration, delivered_J exceeds the stored energy at the start less the stored
// energy now by at most the sampling error of a held spring, K |step|^2 / 2 per tick. Damping of at
// least K dt / 2 compensates this error where the bound leaves it room.
double stored_J(const Effect& effect, const EffectState& state, const Vec3& p_W);

// Returns the largest stiffness and damping of the effect (law.h).
LawSlopes steepest(const Effect& effect);

}  // namespace tactus::rendering
