#include "firmware/control/effort_path.h"

#include <algorithm>

#include "firmware/safety/faults.h"
#include "firmware/safety/force_limiter.h"

namespace tactus::firmware {

void EffortPath::configure(const ControllerConfig& config) {
  gravity.configure(config);
  friction.configure(config);
  limits = config.joints;
}

void EffortPath::rest() {
  gravity.rest();
  friction.rest();
}

ActiveEfforts EffortPath::distribute(const EffortInputs& inputs) {
  ActiveEfforts efforts;
  hold_weights(inputs, efforts);
  const double scale = effort_scale(inputs.effort, limits, efforts.gravity);
  efforts.found |= scale < 1.0 ? kLimitEffort : kNoFault;
  efforts.force_W = scale * inputs.force_W;
  const Vec3 given = scale * inputs.effort + efforts.gravity;
  push_along(inputs, given, efforts);
  if ((efforts.found & kFaultMask) != 0) {
    return efforts;
  }
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    const auto axis = static_cast<Eigen::Index>(joint);
    // Both sums are within the limit except for rounding and the push of the sign check.
    const double most = limits[joint].max_effort;
    const double compensated = friction.is_on()
                                   ? std::clamp(given[axis] + efforts.friction[axis], -most, most)
                                   : given[axis];
    efforts.all[joint] = std::clamp(compensated + inputs.push[joint], -most, most);
  }
  return efforts;
}

// Adds the efforts that hold the mechanism's own weights.
void EffortPath::hold_weights(const EffortInputs& inputs, ActiveEfforts& efforts) {
  if (!gravity.is_on()) {
    return;
  }
  const ToolLocator& locator = inputs.locator;
  const GravityHold hold =
      gravity.hold(locator.mechanism, joints_of(inputs.sample.position), locator.pose);
  efforts.found |= hold.is_held_back ? kLimitGravity : kNoFault;
  efforts.gravity = hold.effort;
}

// Adds the efforts that compensate the joints' friction. `given` are the efforts that are commanded
// already.
void EffortPath::push_along(const EffortInputs& inputs, const Vec3& given, ActiveEfforts& efforts) {
  if (!friction.is_on()) {
    return;
  }
  const PushRoom room{.pose = inputs.locator.pose,
                      .effort = given,
                      .force_N = std::max(0.0, inputs.max_force_N - length_of(efforts.force_W))};
  const FrictionPush push =
      friction.push(joints_of(inputs.sample.position), joints_of(inputs.sample.velocity), room);
  if (!push.effort.allFinite()) {
    efforts.found |= kFaultCommandNotFinite;
    return;
  }
  efforts.found |= push.is_held_back ? kLimitCompensation : kNoFault;
  efforts.friction = push.effort;
}

}  // namespace tactus::firmware
