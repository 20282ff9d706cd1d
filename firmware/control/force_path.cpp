#include "firmware/control/force_path.h"

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// The limits that hold a force back and therefore have a source.
constexpr std::uint64_t kForceLimits =
    kLimitForce | kLimitSlew | kLimitEffort | kLimitWorkspace | kLimitSpeed | kLimitPassivity;

}  // namespace

void ForcePath::configure(const ControllerConfig& config) {
  energy.configure(config);
  passivity.configure(config);
  limiter.configure(config);
}

void ForcePath::restart() {
  energy.restart();
  passivity.restart();
  limiter.restart();
}

// The order of the steps is that of firmware/README.md, "One tick".
SafeForce ForcePath::limit(const ForceInputs& inputs, const Guards& guards, ModeMachine& modes) {
  if (modes.mode() != Mode::active) {
    return {};
  }
  const auto& [touch, tool, step_s] = inputs;
  const bool pushes =
      touch.contact != rendering::ContactKind::none || modes.has_raised(kLimitWorkspace);
  modes.raise(passivity.observe(energy.settle(tool.p_W, touch, step_s), pushes));
  if (modes.mode() != Mode::active) {
    return {};
  }
  const Vec3 added_W = added_force(inputs, guards, pushes, modes);
  const LimitedForce soft = limiter.soften(touch.force_W + added_W, touch.parts.effect_W, pushes);
  // Until every motor has answered, the force stays so small that a reversed motor cannot hurt.
  if (!guards.signs.is_done()) {
    limiter.hold_below(guards.signs.force_limit_N());
  }
  const SlowedForce slowed = guards.motion.slow(soft.force_W, tool.v_W);
  const LimitedForce limited = limiter.limit(slowed.force_W);
  modes.raise(soft.limits | slowed.limits | limited.limits);

  SafeForce safe{.force_W = limited.force_W};
  if (modes.has_raised(kForceLimits)) {
    safe.limited_source =
        modes.has_raised(kLimitPassivity) ? energy.most_giving() : strongest_part(touch, added_W);
  }
  return safe;
}

// Returns the force of the workspace walls and of the passivity controller, N.
Vec3 ForcePath::added_force(const ForceInputs& inputs, const Guards& guards, bool pushes,
                            ModeMachine& modes) const {
  Vec3 added_W = passivity.damp_W(inputs.tool.v_W, pushes);
  modes.raise(added_W != Vec3::Zero() ? kLimitPassivity : kNoFault);
  if (modes.has_raised(kLimitWorkspace)) {
    added_W += guards.walls.push_W(inputs.tool);
  }
  return added_W;
}

void ForcePath::apply(const Vec3& force_W) {
  limiter.applied(force_W);
  energy.hold(force_W);
}

}  // namespace tactus::firmware
