// Limits a rendered force to one that is safe for a hand. One thread; real time. Once per tick, in
// this order:
//
//   soft start  f1 = (e + s g(ticks since first contact / contact_start_s))
//                    g(ticks since activation / soft_start_s),   g(x) = min(x, 1),
//               with e the force of the effects and s the rest. The first contact is the first tick
//               in contact after activation, or the tick of activation itself if the tool is
//               pressed into something then. Effects need no contact, so its ramp does not act on
//               them.
//   clamp       |f2| <= max_force_N, in the direction of f1. A limit that is raised while there is
//               force takes soft_start_s to come in; a lowered one acts at once.
//   slew        |f3 - last| <= force_slew_N_per_s / rate_hz, straight from the last force toward f2
//
// The slew limits rise and fall of the force vector. The zero force of a fault or a disable does
// not pass through this class.
#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/configuration/controller_config.h"
#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// A force and the limits that acted on it.
struct LimitedForce {
  Vec3 force_W = Vec3::Zero();  // N
  // The FaultBits of the limits that held the force back.
  std::uint64_t limits = 0;
};

// The limiter of one tool.
class ForceLimiter {
 public:
  // Takes limits and ramps, and restarts.
  void configure(const ControllerConfig& config);

  // Takes new limits. Ramps and slew continue from where they are, and the largest force rises
  // gradually from its present value.
  void retune(const ControllerConfig& config);

  // Starts both ramps and the slew from zero force. Call at activation.
  void restart();

  // Lowers the largest force to `force_N` now; it rises again from there.
  void hold_below(double force_N) { max_force_N_ = std::min(max_force_N_, force_N); }

  // Returns the force after the soft start, the first stage. `force_W` is the whole force and
  // `effect_W` the effects' part of it; both are finite, N.
  LimitedForce soften(const Vec3& force_W, const Vec3& effect_W, bool in_contact);

  // Returns the force after clamp and slew. `force_W` is finite and comes from soften().
  LimitedForce limit(const Vec3& force_W);

  // Returns the largest force of this tick, N.
  [[nodiscard]] double max_force_N() const { return max_force_N_; }

  // Sets the force that went out in the end, N, from which the next slew starts. The effort limit
  // may have scaled it.
  void applied(const Vec3& force_W) { last_W_ = force_W; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  // The configured largest force, N.
  double wanted_max_force_N_ = 0.0;
  // The present limit, N; it rises to the wanted one.
  double max_force_N_ = 0.0;
  // The largest step of the force vector in a tick, N.
  double max_step_N_ = 0.0;
  double activation_gain_per_tick_ = 1.0;
  double contact_gain_per_tick_ = 1.0;
  // The gains of the two ramps, 0 to 1.
  double activation_gain_ = 0.0;
  double contact_gain_ = 0.0;
  // True from the first contact since activation on.
  bool touched_ = false;
  // The force that went out in the last tick, N.
  Vec3 last_W_ = Vec3::Zero();
};

// Returns by how much a gain rises per tick to go from 0 to 1 in `duration_s`.
double gain_per_tick(double duration_s, double rate_hz);

// Returns the Euclidean length. It does not overflow for finite vectors.
double length_of(const Vec3& v);

// Returns the factor in [0, 1] by which all of `effort` must be scaled so that `given` plus the
// scaled effort is within each joint's limit. All are finite, and `given` is within the limits.
double effort_scale(const Vec3& effort, const std::array<JointLimits, kJointCount>& limits,
                    const Vec3& given = Vec3::Zero());

}  // namespace tactus::firmware
