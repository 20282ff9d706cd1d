// The guards of a tick, in their order. What they find goes to the mode machine, which raises it.
// One thread; real time. safety/README.md describes each guard.
#pragma once

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/control/mode_machine.h"
#include "firmware/kinematics/pose.h"
#include "firmware/safety/effort_guard.h"
#include "firmware/safety/encoder_guard.h"
#include "firmware/safety/loop_check.h"
#include "firmware/safety/motion_guard.h"
#include "firmware/safety/motor_sign_check.h"
#include "firmware/safety/sample_check.h"
#include "firmware/safety/workspace_walls.h"
#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::firmware {

// The inputs of a tick, as the guards see them.
struct TickInputs {
  const drivers::JointSample& sample;
  const LoopReport& loop;
  // The efforts that the motors have held since the last command, N or N m.
  const JointEfforts& held;
  // True if the controller is configured and the device knows its joints' positions.
  bool is_referenced = false;
};

// The place and motion of the tool in a tick.
struct ToolMotion {
  const Pose& pose;
  const rendering::ToolState& tool;
  // The force of the last tick, N.
  const Vec3& held_W;
};

// All guards of a controller. The members are public because the stages of the force ask some of
// them, and because the state saves them in the order of its format.
struct Guards {
  // Configures all guards.
  void configure(const ControllerConfig& config);

  // Checks the loop's report, the sample and the encoders, the first stage of a tick.
  void check_inputs(const TickInputs& inputs, ModeMachine& modes);

  // Checks the tool's place and speed, then the motors. Call in the ticks in which the tool has a
  // place, with finite values.
  void check_tool(const TickInputs& inputs, const ToolMotion& located, ModeMachine& modes);

  LoopCheck loop;
  SampleCheck sample;
  EncoderGuard encoders;
  WorkspaceWalls walls;
  MotionGuard motion;
  EffortGuard efforts;
  MotorSignCheck signs;

 private:
  void check_encoders(const TickInputs& inputs, ModeMachine& modes);
  void check_motors(const TickInputs& inputs, const Pose& pose, ModeMachine& modes);
};

}  // namespace tactus::firmware
