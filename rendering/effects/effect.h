// Forces that need no surface: fields, springs and signals, each bounded, and each with an account
// of the energy that it gave to the hand.
#pragma once

#include <variant>

#include "rendering/effects/phase.h"
#include "rendering/surface/primitive.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// Everything is in the world frame. p is the tool's position, v its velocity, and d the vector from
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

// A constant field: the same force everywhere.
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

// The state of one effect for one tool. EffectState{} is its initial value.
struct EffectState {
  Vec3 last_tool_W = Vec3::Zero();
  Vec3 held_force_W = Vec3::Zero();  // N, what the hand felt since the last tick
  double delivered_J = 0.0;          // to the hand, so far: the held forces times the tool's steps
  Vec3 anchor_W = Vec3::Zero();      // of StickSlip
  Phase phase = 0;                   // of Vibration
  bool started = false;
};

// Returns true if every number is finite, coefficients are not negative, directions are unit to
// 1e-9, and fields marked > 0 are.
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

}  // namespace tactus::rendering
