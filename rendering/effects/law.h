// The common part of the effect laws: what a law is asked, and what it answers.
//
// A law is a struct in laws/ with its name in kName, its fields in visit_fields (law_fields.h), and
// three functions: force_of, stored_by and steepest_of.
#pragma once

#include "rendering/effects/law_fields.h"
#include "rendering/effects/phase.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// The state of one effect for one tool. EffectState{} is its initial value.
struct EffectState {
  Vec3 last_tool_W = Vec3::Zero();
  Vec3 held_force_W = Vec3::Zero();  // N, what the hand felt since the last tick
  double delivered_J = 0.0;          // to the hand, so far: the held forces times the tool's steps
  Vec3 anchor_W = Vec3::Zero();      // of StickSlip
  Phase phase = 0;                   // of Vibration
  bool started = false;
};

struct LawInput {
  const ToolState& tool;
  EffectState& state;  // anchor and phase are the law's to change
  double dt_s;
  double max_force_N;
};

struct LawForce {
  Vec3 elastic_W = Vec3::Zero();  // N, no longer than max_force_N
  Vec3 damping_W = Vec3::Zero();  // N, any length, never with the velocity
};

struct LawPlace {
  const EffectState& state;
  const Vec3& p_W;
  double max_force_N;
};

// The largest stiffness and damping of a law anywhere, along any direction: how much its force
// grows against a motion, per metre and per m/s. A force that grows with the motion has none. The
// firmware adds them to what else is felt there, and compares the sum with what the device can
// hold.
struct LawSlopes {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
};

// `v` shortened to the length `most`.
inline Vec3 bounded(const Vec3& v, double most) {
  const double length = v.norm();
  return length > most ? Vec3{most / length * v} : v;
}

// The energy of a spring of length d whose pull stops growing at `most`.
inline double spring_energy(double stiffness, double d, double most) {
  if (stiffness * d <= most) {
    return 0.5 * stiffness * d * d;
  }
  return most * (d - 0.5 * most / stiffness);
}

}  // namespace tactus::rendering
