#include "firmware/control/controller.h"

#include "firmware/control/tick_record.h"
#include "firmware/limits.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

static_assert(sizeof(Controller) <= kMaxControllerBytes);

// Clears the joints beyond those of the mechanism, which a device may report.
void forget_beyond(std::size_t joint_count, drivers::JointSample& sample) {
  for (std::size_t joint = joint_count; joint < drivers::kMaxJoints; ++joint) {
    sample.position[joint] = 0.0;
    sample.velocity[joint] = 0.0;
    sample.effort[joint] = 0.0;
    sample.effort_known &= ~(1U << joint);
  }
}

}  // namespace

drivers::JointCommand Controller::tick(const drivers::JointSample& fresh, Request request) {
  Stopwatch watch(now_ns_);
  const NextTick now = next_;
  next_ = {.number = now.number + 1, .write_status = now.write_status};
  drivers::JointSample sample = fresh;
  sample.status |= now.write_status;
  forget_beyond(joint_count(settings_.config.mechanism), sample);
  const double rate_hz = settings_.config.rate_hz;
  open_record(now, sample, request, rate_hz, record_);
  modes_.begin_tick();
  const TickInputs inputs{.sample = sample,
                          .loop = now.loop,
                          .held = now.held_effort,
                          .is_referenced = settings_.is_configured && is_referenced(sample.status)};

  guards_.check_inputs(inputs, modes_);
  advance_mode(inputs, request);
  record_.stage_ns.check = watch.lap_ns();

  const bool is_located = locate(inputs);
  record_.stage_ns.kinematics = watch.lap_ns();

  const rendering::Touch touched = touch(is_located);
  record_.stage_ns.touch = watch.lap_ns();
  record_touch(touched, record_);

  // The held force acted over the missed ticks, too.
  const double step_s = (1.0 + now.loop.missed_ticks) / rate_hz;
  const SafeForce safe = force_path_.limit(
      {.touch = touched, .tool = locator_.tool, .step_s = step_s}, guards_, modes_);
  record_.limited_source = safe.limited_source;
  const drivers::JointCommand command = command_joints(inputs, safe.force_W);
  next_.held_effort = command.effort;
  record_.stage_ns.safety = watch.lap_ns();

  close_record({.modes = modes_,
                .guards = guards_,
                .force = force_path_,
                .tool = locator_.tool,
                .command = command},
               record_);
  return command;
}

// Advances the mode and does the work of entering the new one. Faults of the inputs have been
// raised already.
void Controller::advance_mode(const TickInputs& inputs, Request request) {
  modes_.raise(settings_.is_configured ? kNoFault : kFaultNotConfigured);
  const EnteredModes entered = modes_.advance(inputs.is_referenced, request);
  // Homing moves the joints' zero, so the tool starts at its new position without contact.
  if (entered.ready_from_homing) {
    scene_.world.reset();
    locator_.velocity_filter.reset();
  }
  if (entered.active) {
    guards_.signs.restart();
    force_path_.restart();
  }
}

// Computes the tool's position and velocity, and checks them. Returns false if the joints are not
// referenced or the kinematics fail; the tool then stays where it was, at rest.
bool Controller::locate(const TickInputs& inputs) {
  locator_.rest();
  if (!inputs.is_referenced || !has_positions(modes_.mode()) ||
      modes_.has_raised(kFaultJointNotFinite)) {
    return false;
  }
  const Location location = locator_.locate(inputs.sample);
  modes_.raise(location.faults);
  if (!location.is_finite) {
    return false;
  }
  guards_.check_tool(
      inputs, {.pose = locator_.pose, .tool = locator_.tool, .held_W = force_path_.energy.held_W()},
      modes_);
  return locator_.pose.status == kPoseGood;
}

// Computes the touch. It does so in `ready` too, without force: the proxy then rests on the surface
// into which the tool is pushed, and activation raises the force from there.
rendering::Touch Controller::touch(bool is_located) {
  if (!is_located || (modes_.mode() != Mode::ready && modes_.mode() != Mode::active)) {
    return free_touch(locator_.tool);
  }
  advance_changes();
  rendering::Touch touch = scene_.world.touch(locator_.tool, scene_.watcher);
  if (!is_finite(touch)) {
    modes_.raise(kFaultForceNotFinite);
    return free_touch(locator_.tool);
  }
  modes_.raise(touch.flags != rendering::kTouchClean ? kLimitTouch : kNoFault);
  return touch;
}

// Advances the changes of materials. They change the force no faster than an activation with the
// largest force does; without force they act at once.
void Controller::advance_changes() {
  if (!scene_.changes.any()) {
    return;
  }
  if (modes_.mode() != Mode::active) {
    scene_.complete_changes();
    return;
  }
  const SafetyConfig& safety = settings_.config.safety;
  const double most_N =
      safety.max_force_N * gain_per_tick(safety.soft_start_s, settings_.config.rate_hz);
  const bool goes_on = scene_.advance_changes(most_N, length_of(locator_.tool.v_W));
  modes_.raise(goes_on ? kLimitChange : kNoFault);
}

// Returns the joint efforts of the force, with the two compensations and the push of the sign
// check.
drivers::JointCommand Controller::command_joints(const TickInputs& inputs, const Vec3& force_W) {
  const Vec3 effort = joint_effort(locator_.pose, force_W);
  modes_.raise(effort.allFinite() ? kNoFault : kFaultCommandNotFinite);
  if (modes_.mode() != Mode::active) {
    return command_nothing();
  }
  const ActiveEfforts efforts =
      effort_path_.distribute({.sample = inputs.sample,
                               .locator = locator_,
                               .effort = effort,
                               .force_W = force_W,
                               .max_force_N = force_path_.limiter.max_force_N(),
                               .push = guards_.signs.push()});
  record_efforts(efforts, record_);
  modes_.raise(efforts.found);
  if (modes_.mode() != Mode::active) {
    return command_nothing();
  }
  force_path_.apply(efforts.force_W);
  record_.force_commanded_W = to_triple(efforts.force_W);
  return {.effort = efforts.all, .enable = true};
}

// Returns the command of a tick without motor power.
drivers::JointCommand Controller::command_nothing() {
  effort_path_.rest();
  force_path_.apply_nothing();
  return {.home = modes_.mode() == Mode::homing, .power_off = modes_.mode() == Mode::fault};
}

void Controller::note_transfers(std::uint32_t write_status, std::uint32_t read_ns,
                                std::uint32_t write_ns) {
  next_.write_status = write_status;
  record_.stage_ns.read = read_ns;
  record_.stage_ns.write = write_ns;
}

}  // namespace tactus::firmware
