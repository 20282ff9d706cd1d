#include "firmware/control/device_controller.h"

#include "firmware/control/loaded_scene.h"
#include "firmware/control/tick_record.h"
#include "firmware/limits.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// Clears the joints beyond those of the mechanism, which a device may report.
void forget_beyond(std::size_t joint_count, drivers::JointSample& sample) {
  for (std::size_t joint = joint_count; joint < drivers::kMaxJoints; ++joint) {
    sample.position[joint] = 0.0;
    sample.velocity[joint] = 0.0;
    sample.effort[joint] = 0.0;
    sample.effort_known &= ~(1U << joint);
    sample.effort_is_new &= ~(1U << joint);
  }
}

}  // namespace

void DeviceController::configure(const ControllerConfig& config) {
  settings_ = {.config = config, .configured_safety = config.safety, .is_configured = true};
  next_ = NextTick{};
  modes_.configure(config.safety.guards_off);
  guards_.configure(config);
  locator_.configure(config);
  force_path_.configure(config);
  effort_path_.configure(config);
  record_ = TelemetryRecord{};
}

TickInputs DeviceController::inputs() const {
  return {.sample = tick_.sample,
          .loop = tick_.now.loop,
          .held = tick_.now.held_effort,
          .is_referenced = settings_.is_configured && is_referenced(tick_.sample.status)};
}

bool DeviceController::begin(const drivers::JointSample& fresh, Request request) {
  tick_.watch = Stopwatch(now_ns_);
  tick_.now = next_;
  next_ = {.number = tick_.now.number + 1, .write_status = tick_.now.write_status};
  tick_.sample = fresh;
  tick_.sample.status |= tick_.now.write_status;
  forget_beyond(joint_count(settings_.config.mechanism), tick_.sample);
  open_record(tick_.now, tick_.sample, request, settings_.config.rate_hz, record_);
  modes_.begin_tick();
  guards_.check_inputs(inputs(), modes_);
  const bool has_moved = advance_mode(request);
  record_.stage_ns.check = tick_.watch.lap_ns();
  return has_moved;
}

// Advances the mode and does the work of entering the new one. Faults of the inputs have been
// raised already. Returns true if homing has moved the joints' zero.
bool DeviceController::advance_mode(Request request) {
  modes_.raise(settings_.is_configured ? kNoFault : kFaultNotConfigured);
  const EnteredModes entered = modes_.advance(inputs().is_referenced, request);
  if (entered.ready_from_homing) {
    locator_.velocity_filter.reset();
  }
  if (entered.active) {
    guards_.signs.restart();
    force_path_.restart();
  }
  return entered.ready_from_homing;
}

void DeviceController::stop_for(std::size_t device) {
  modes_.raise_for(static_cast<std::uint32_t>(device + 1));
}

std::uint64_t DeviceController::faults_for_all() const {
  // An operator who stops one device means all.
  const std::uint64_t shared =
      settings_.config.on_fault == OnFault::all ? ~kFaultOtherDevice : kFaultOperatorStop;
  return modes_.faults() & shared;
}

void DeviceController::locate() {
  tick_.is_located = find_tool();
  record_.stage_ns.kinematics = tick_.watch.lap_ns();
}

// Returns false if the joints are not referenced or the kinematics fail; the tool then stays where
// it was, at rest.
bool DeviceController::find_tool() {
  locator_.rest();
  const TickInputs now = inputs();
  if (!now.is_referenced || !has_positions(modes_.mode()) ||
      modes_.has_raised(kFaultJointNotFinite)) {
    return false;
  }
  const Location location = locator_.locate(now.sample);
  modes_.raise(location.faults);
  if (!location.is_finite) {
    return false;
  }
  guards_.check_tool(
      now, {.pose = locator_.pose, .tool = locator_.tool, .held_W = force_path_.energy.held_W()},
      modes_);
  return locator_.pose.status == kPoseGood;
}

void DeviceController::take(const rendering::Touch& touch) {
  const bool is_good = is_finite(touch);
  tick_.touch = is_good ? touch : free_touch(locator_.tool);
  modes_.raise(is_good ? kNoFault : kFaultForceNotFinite);
  modes_.raise(tick_.touch.flags != rendering::kTouchClean ? kLimitTouch : kNoFault);
  record_.stage_ns.touch = tick_.watch.lap_ns();
  record_touch(tick_.touch, record_);
}

double DeviceController::largest_change_N() const {
  const SafetyConfig& safety = settings_.config.safety;
  return safety.max_force_N * gain_per_tick(safety.soft_start_s, settings_.config.rate_hz);
}

void DeviceController::note_change() {
  modes_.raise(kLimitChange);
}

void DeviceController::drive() {
  // The held force acted over the missed ticks, too.
  const double step_s = (1.0 + tick_.now.loop.missed_ticks) / settings_.config.rate_hz;
  const SafeForce safe = force_path_.limit(
      {.touch = tick_.touch, .tool = locator_.tool, .step_s = step_s}, guards_, modes_);
  record_.limited_source = safe.limited_source;
  distribute(safe.force_W);
}

// Computes the joint efforts of the force, with the two compensations and the push of the sign
// check. In a mode without force it computes none.
void DeviceController::distribute(const Vec3& force_W) {
  const Vec3 effort = joint_effort(locator_.pose, force_W);
  modes_.raise(effort.allFinite() ? kNoFault : kFaultCommandNotFinite);
  if (modes_.mode() != Mode::active) {
    return;
  }
  const ActiveEfforts efforts =
      effort_path_.distribute({.sample = tick_.sample,
                               .locator = locator_,
                               .effort = effort,
                               .force_W = force_W,
                               .max_force_N = force_path_.limiter.max_force_N(),
                               .push = guards_.signs.push()});
  record_efforts(efforts, record_);
  modes_.raise(efforts.found);
  tick_.command = {.effort = efforts.all, .enable = true};
  tick_.force_W = efforts.force_W;
}

drivers::JointCommand DeviceController::close() {
  if (modes_.mode() == Mode::active) {
    force_path_.apply(tick_.force_W);
    record_.force_commanded_W = to_triple(tick_.force_W);
  } else {
    effort_path_.rest();
    force_path_.apply_nothing();
    tick_.command = {.home = modes_.mode() == Mode::homing,
                     .power_off = modes_.mode() == Mode::fault};
  }
  next_.held_effort = tick_.command.effort;
  record_.stage_ns.safety = tick_.watch.lap_ns();
  close_record({.modes = modes_,
                .guards = guards_,
                .force = force_path_,
                .tool = locator_.tool,
                .command = tick_.command},
               record_);
  return tick_.command;
}

void DeviceController::note_transfers(std::uint32_t write_status, std::uint32_t read_ns,
                                      std::uint32_t write_ns) {
  next_.write_status = write_status;
  record_.stage_ns.read = read_ns;
  record_.stage_ns.write = write_ns;
}

}  // namespace tactus::firmware
