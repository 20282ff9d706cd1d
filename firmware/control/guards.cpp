#include "firmware/control/guards.h"

#include "firmware/safety/faults.h"

namespace tactus::firmware {

void Guards::configure(const ControllerConfig& config) {
  loop.configure(config);
  sample.configure(config);
  encoders.configure(config);
  walls.configure(config);
  motion.configure(config);
  efforts.configure(config);
  signs.configure(config);
}

void Guards::check_inputs(const TickInputs& inputs, ModeMachine& modes) {
  modes.raise(loop.check(inputs.loop));
  modes.raise(sample.check(inputs.sample));
  check_encoders(inputs, modes);
}

// Runs the encoder guard while the device is referenced. Before, positions mean nothing, and homing
// changes their zero.
void Guards::check_encoders(const TickInputs& inputs, ModeMachine& modes) {
  if (!inputs.is_referenced || !has_positions(modes.mode())) {
    encoders.rest();
    motion.rest();
  } else if (modes.has_raised(kLimitStaleSample | kFaultJointNotFinite)) {
    encoders.pass();
  } else {
    modes.raise(encoders.check(inputs.sample, inputs.held, inputs.loop.missed_ticks) &
                ~(modes.mode() == Mode::active ? kNoFault : kFaultTorqueWithoutMotion));
  }
}

void Guards::check_tool(const TickInputs& inputs, const ToolMotion& located, ModeMachine& modes) {
  modes.raise(walls.check(located.tool.p_W) | motion.check(located.tool.v_W, located.held_W));
  check_motors(inputs, located.pose, modes);
}

// Runs the guards of the motors while these have power.
void Guards::check_motors(const TickInputs& inputs, const Pose& pose, ModeMachine& modes) {
  if (modes.mode() != Mode::active || pose.status != kPoseGood) {
    efforts.rest();
    signs.pass();
    return;
  }
  if (modes.has_raised(kLimitStaleSample)) {
    efforts.pass(inputs.held);
    signs.pass();
    return;
  }
  modes.raise(efforts.check(inputs.sample, pose, inputs.held));
  if (inputs.loop.missed_ticks != 0) {
    signs.pass();
  }
  modes.raise(signs.step(inputs.sample, pose, inputs.held));
  modes.raise(signs.is_done() ? kNoFault : kLimitSignCheck);
}

}  // namespace tactus::firmware
