// Makes a rendered force fit for a hand. In this order, once a tick:
//
//  soft start  f1 = (e + s g(ticks since first contact / contact_start_s))
//                   g(ticks since activation / soft_start_s),
//              g(x) = x below 1, then 1, e what the effects give and s all the rest. First contact
//              is the first tick in contact after activation, which is the tick of activation
//              itself when the tool is already pressed into something. Effects need no contact: a
//              first contact neither brings them in nor holds them back.
//  clamp       |f2| <= max_force_N, same direction as f1. A limit that is raised while the force
//              is on comes in within soft_start_s; one that is lowered holds at once.
//  slew        |f3 - last| <= force_slew_N_per_s / rate_hz, straight from the last force toward f2
//
// The slew works both ways, on the force vector. Zero force by a fault or a disable does not pass
// through here.
#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/configuration/controller_config.h"
#include "rendering/geometry/vector.h"
#include "rendering/state/state_archive.h"

namespace tactus::firmware {

struct LimitedForce {
  Vec3 force_W = Vec3::Zero();  // N
  std::uint64_t limits = 0;     // FaultBits: which of the limits held the force back
};

class ForceLimiter {
 public:
  void configure(const ControllerConfig& config);

  // Takes the limits alone: ramps and slew go on from where they are, and the largest force rises
  // from the one that held before.
  void retune(const ControllerConfig& config);

  // Activation: both ramps and the slew start again from zero force.
  void restart();

  // The largest force is no more than this now, and rises again from there, N.
  void hold_below(double force_N) { max_force_N_ = std::min(max_force_N_, force_N); }

  // Soft start, the first stage: `force_W` is all of the force and `effect_W` the effects' part of
  // it, both finite.
  LimitedForce soften(const Vec3& force_W, const Vec3& effect_W, bool in_contact);

  // Clamp and slew, of what soften() gave. Finite.
  LimitedForce limit(const Vec3& force_W);

  // The largest force of this tick, N.
  [[nodiscard]] double max_force_N() const { return max_force_N_; }

  // The force that in the end went out (the effort limit may have scaled it): the next slew starts
  // from it.
  void applied(const Vec3& force_W) { last_W_ = force_W; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  double wanted_max_force_N_ = 0.0;
  double max_force_N_ = 0.0;  // now; it rises to the wanted one
  double max_step_N_ = 0.0;
  double activation_gain_per_tick_ = 1.0;
  double contact_gain_per_tick_ = 1.0;
  double activation_gain_ = 0.0;
  double contact_gain_ = 0.0;
  bool touched_ = false;
  Vec3 last_W_ = Vec3::Zero();
};

// What a gain from 0 to 1 rises a tick.
double gain_per_tick(double duration_s, double rate_hz);

// Euclidean length that does not overflow for finite vectors.
double length_of(const Vec3& v);

// The factor in [0, 1] that brings every joint's effort, on top of the one it already has to give,
// within its limit and keeps their ratios. Efforts finite, and `given` within the limits.
double effort_scale(const Vec3& effort, const std::array<JointLimits, kJointCount>& limits,
                    const Vec3& given = Vec3::Zero());

}  // namespace tactus::firmware
