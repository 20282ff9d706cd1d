// The path from the force to the joints: the efforts of the force, of the mechanism's weights and
// of the joints' friction, within the joints' limits. One thread; real time.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/control/friction_compensation.h"
#include "firmware/control/gravity_compensation.h"
#include "firmware/control/tool_locator.h"
#include "firmware/safety/encoder_guard.h"
#include "rendering/geometry/vector.h"

namespace tactus::firmware {

// The inputs of the path in an active tick.
struct EffortInputs {
  const drivers::JointSample& sample;
  const ToolLocator& locator;
  // The efforts J^T f of the force f, N or N m; finite.
  const Vec3& effort;
  // The force f, and the largest that a hand may feel in this tick, N.
  const Vec3& force_W;
  double max_force_N = 0.0;
  // The push of the sign check, N or N m. It counts in no limit but each joint's own.
  const JointEfforts& push;
};

// The efforts of an active tick.
struct ActiveEfforts {
  // The FaultBits that the path has found. With a fault, `all` and `friction` are zero.
  std::uint64_t found = 0;
  // The whole effort of each joint, N or N m.
  JointEfforts all{};
  // The force, N, scaled into the limits that gravity leaves.
  Vec3 force_W = Vec3::Zero();
  // The parts of `all` that hold the weights and that compensate friction, N or N m.
  Vec3 gravity = Vec3::Zero();
  Vec3 friction = Vec3::Zero();
};

// The path of one mechanism. The members are public because the state saves them in the order of
// its format.
struct EffortPath {
  // Takes the joints' limits and both compensations.
  void configure(const ControllerConfig& config);

  // Lets the compensations start anew. Call in every tick that is not active.
  void rest();

  // Returns the efforts. The rendered force is scaled into the limits that gravity leaves, friction
  // into the limits that both leave.
  ActiveEfforts distribute(const EffortInputs& inputs);

  GravityCompensation gravity;
  FrictionCompensation friction;
  std::array<JointLimits, kJointCount> limits{};

 private:
  void hold_weights(const EffortInputs& inputs, ActiveEfforts& efforts);
  void push_along(const EffortInputs& inputs, const Vec3& given, ActiveEfforts& efforts);
};

}  // namespace tactus::firmware
