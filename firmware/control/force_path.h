// The path of the force from the touch to the limits of a hand: the energy account, the passivity
// controller and the force limiter, with the guards that add to the force or take it away. One
// thread; real time.
#pragma once

#include "firmware/configuration/controller_config.h"
#include "firmware/control/guards.h"
#include "firmware/control/mode_machine.h"
#include "firmware/safety/energy_account.h"
#include "firmware/safety/force_limiter.h"
#include "firmware/safety/passivity.h"
#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::firmware {

// The inputs of the path in a tick.
struct ForceInputs {
  const rendering::Touch& touch;
  const rendering::ToolState& tool;
  // The time since the previous tick, s, with the missed ticks.
  double step_s = 0.001;
};

// A force that is safe for a hand.
struct SafeForce {
  Vec3 force_W = Vec3::Zero();  // N
  // The source that gives most while a limit holds the force back.
  EnergySource limited_source = EnergySource::contact;
};

// The path of one tool. The members are public because the state saves them in the order of its
// format.
struct ForcePath {
  void configure(const ControllerConfig& config);

  // Starts the ramps, the ledger and the passivity observer anew. Call at activation.
  void restart();

  // Returns the rendered force with the forces of walls and passivity damping, limited for a hand.
  // It is zero unless the mode is `active` after the guards of this stage. All inputs are finite.
  SafeForce limit(const ForceInputs& inputs, const Guards& guards, ModeMachine& modes);

  // Takes the force that goes out in the end, N: the joints' effort limits may have scaled it.
  void apply(const Vec3& force_W);
  // Takes that no force goes out.
  void apply_nothing() { energy.hold(Vec3::Zero()); }

  EnergyAccount energy;
  PassivityControl passivity;
  ForceLimiter limiter;

 private:
  Vec3 added_force(const ForceInputs& inputs, const Guards& guards, bool pushes,
                   ModeMachine& modes) const;
};

}  // namespace tactus::firmware
