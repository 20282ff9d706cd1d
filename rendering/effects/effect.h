// Forces that need no surface: fields, springs and signals, each bounded, and each with an account
// of the energy that it gave to the hand.
#pragma once

#include <variant>

#include "rendering/effects/phase.h"
#include "rendering/surface/primitive.h"
#include "rendering/world/touch.h"

namespace tactus::rendering {

// Everything is in the world frame. p is the tool's position, v its velocity, and d the way from
// the tool to the anchor.

// K d.
struct Spring {
  Vec3 anchor_W = Vec3::Zero();  // m
  double stiffness_N_per_m = 0.0;
};

// K d - B v.
struct SpringDamper {
  Spring spring;
  double damping_Ns_per_m = 0.0;
};

// -(B + C |v|) v inside the volume, growing from nothing at its surface to all at a depth of
// `rim_m`.
struct FluidDrag {
  Primitive volume;
  double linear_Ns_per_m = 0.0;
  double quadratic_Ns2_per_m2 = 0.0;
  double rim_m = 0.0;  // >= 0
};

// Pulls like a pole under a skin of `core_m`: S d / (|d|^2 + core^2)^(3/2), with S such that the
// pull is `strength_N` where it is strongest, at core / sqrt(2). Negative strength pushes away.
struct Magnet {
  Vec3 pole_W = Vec3::Zero();
  double strength_N = 0.0;
  double core_m = 0.01;  // > 0
};

// The same force everywhere.
struct ConstantField {
  Vec3 force_W = Vec3::Zero();  // N
};

// amplitude sin(2 pi frequency t). Silent where the frequency is half the tick rate or more: it
// would come out as another one.
struct Vibration {
  Vec3 direction_W = Vec3::UnitY();  // unit
  double amplitude_N = 0.0;
  double frequency_Hz = 0.0;
};

// A spring to where the tool last stuck. When it pulls harder than `break_force_N` it lets go and
// sticks anew where the tool is.
struct StickSlip {
  double stiffness_N_per_m = 0.0;  // > 0
  double break_force_N = 0.0;
};

// Draws the tool to a target at the distance r: K r up to half the capture distance, from there
// down to nothing at the capture distance, and damped by B within it.
struct SnapLaw {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  double capture_m = 0.01;  // > 0
};

struct SnapToPoint {
  Vec3 point_W = Vec3::Zero();
  SnapLaw law;
};

struct SnapToLine {
  Vec3 point_W = Vec3::Zero();       // anywhere on it
  Vec3 direction_W = Vec3::UnitX();  // unit
  SnapLaw law;
};

struct SnapToPlane {
  Vec3 point_W = Vec3::Zero();    // anywhere on it
  Vec3 normal_W = Vec3::UnitY();  // unit
  SnapLaw law;
};

using EffectLaw = std::variant<Spring, SpringDamper, FluidDrag, Magnet, ConstantField, Vibration,
                               StickSlip, SnapToPoint, SnapToLine, SnapToPlane>;

struct Effect {
  EffectLaw law;
  double max_force_N = 0.0;  // > 0; the force is never larger
};

// What one effect remembers from tick to tick for one tool. Start over with EffectState{}.
struct EffectState {
  Vec3 last_tool_W = Vec3::Zero();
  Vec3 held_force_W = Vec3::Zero();  // N, what the hand felt since the last tick
  double delivered_J = 0.0;          // to the hand, so far: the held forces times the tool's ways
  Vec3 anchor_W = Vec3::Zero();      // of StickSlip
  Phase phase = 0;                   // of Vibration
  bool started = false;
};

// True if every number is finite, coefficients are not negative, directions are unit to 1e-9, and
// what is marked > 0 is.
bool valid(const Effect& effect);

// One tick: settles the account with the tool's new place, and gives the force on the hand (N). The
// effect must be valid, the tool finite, dt_s > 0. Real time: no heap, bounded work.
//
// Where the bound cuts in, the elastic part is cut first and the damping takes what room is left:
// so the one stays conservative and the other dissipative.
Vec3 apply(const Effect& effect, EffectState& state, const ToolState& tool, double dt_s);

// The energy that the effect's elastic part gives back on the way from p_W to where it has the
// least (its anchor, target or pole; of a repelling magnet, infinity). Drag and vibration store
// none; a constant field, which has no such place, counts from the origin and can be below zero.
//
// For every law but Vibration, delivered_J never exceeds what was stored at the start less what is
// stored now by more than the sampling error of a held spring, K |step|^2 / 2 a tick. Damping of at
// least K dt / 2 pays for that where the bound leaves it room.
double stored_J(const Effect& effect, const EffectState& state, const Vec3& p_W);

}  // namespace tactus::rendering
