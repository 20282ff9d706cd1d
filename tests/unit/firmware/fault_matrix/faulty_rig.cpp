#include "tests/unit/firmware/fault_matrix/faulty_rig.h"

#include <cmath>

#include "tests/support/without_sign_check.h"

namespace tactus::firmware {
namespace {

constexpr double kPressed_m = -0.002;
constexpr int kRiseTicks = 600;  // more than both ramps of the soft start

ControllerConfig wide_config(std::uint64_t guards_off) {
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  for (JointLimits& joint : config.joints) {
    joint.lower = -2.0;
    joint.upper = 2.0;
  }
  config.safety.workspace_lower_W = Vec3::Constant(-1.0);
  config.safety.workspace_upper_W = Vec3::Constant(1.0);
  config.safety.blocked_effort_share = 0.05;
  config.safety.device_damping_Ns_per_m = 0.0;
  config.safety.guards_off = guards_off;
  return config;
}

bool watches(const MatrixFault& fault, Mode mode) {
  return (fault.modes >> static_cast<unsigned>(mode) & 1U) != 0;
}

// Back to force through reset, home and enable: never more in a tick than the soft start lets
// through.
std::string check_recovery(FaultyRig& rig) {
  rig.heal();
  rig.device.sample.status = drivers::kDeviceOk;
  rig.device.sample.position[1] = 0.01;
  rig.tick();
  rig.tick();
  rig.tick(Request::reset);
  if (rig.record().mode != Mode::init || rig.record().faults != 0) {
    return "reset does not clear it";
  }
  rig.tick(Request::home);
  rig.tick();
  rig.tick(Request::enable);
  const double gain_per_tick = 1.0 / 500.0;
  for (int tick = 1; tick <= kRiseTicks; ++tick) {
    rig.device.sample.position[1] = tick < 5 ? 0.001 : kPressed_m;
    rig.tick();
    if (rig.record().mode != Mode::active) {
      return "no way back to active";
    }
    const double force_N = std::abs(rig.record().force_commanded_W[1]);
    if (force_N > 1.01 * gain_per_tick * tick) {  // the floor gives 1 N there
      return "the force jumps after the recovery";
    }
  }
  return rig.record().force_commanded_W[1] > 0.9 ? "" : "the force does not come back";
}

}  // namespace

FaultyRig::FaultyRig(std::size_t devices, OnFault on_fault)
    : on_fault_(on_fault),
      controller_(std::span(more_devices_).first(devices - 1),
                  std::span(more_tools_).first(devices - 1)) {}

void FaultyRig::tick(Request request, Request of_companion) {
  companion.sample.position = {0.05, kPressed_m + (ticks_++ % 2 == 0 ? 1e-5 : 0.0), 0.0};
  const std::array<ScriptedDevice*, 2> devices{&device, &companion};
  const std::array<Request, 2> requests{request, of_companion};
  run_tick(controller_, std::span<ScriptedDevice* const>(devices), requests);
}

// Brings the companion, if there is one, to `active`, beside a device that rests above the floor.
bool FaultyRig::start_companion() {
  if (controller_.device_count() == 1) {
    return true;
  }
  companion.sample = {};
  device.sample = {};
  device.write_status = drivers::kDeviceOk;
  device.sample.position[1] = 0.01;
  tick(Request::none, Request::home);
  tick();
  tick(Request::none, Request::enable);
  for (int i = 0; i < kRiseTicks; ++i) {
    tick();
  }
  return companion.has_torque();
}

void FaultyRig::heal() {
  device.sample = {};
  device.sample.position = {0.0, kPressed_m, 0.0};
  device.sample.status = is_homing_ ? drivers::kDeviceHoming : drivers::kDeviceOk;
  device.write_status = drivers::kDeviceOk;
}

bool FaultyRig::enter(Mode mode, std::uint64_t guards_off) {
  is_homing_ = mode == Mode::homing;
  ControllerConfig config = wide_config(guards_off);
  config.on_fault = on_fault_;
  for (std::size_t i = 0; i < controller_.device_count(); ++i) {
    if (!controller_.configure(config, i)) {
      return false;
    }
  }
  if (!controller_.load_scene(floor_.objects(), {.tool_radius_m = 0.0}) || !start_companion()) {
    return false;
  }
  heal();
  if (mode == Mode::init) {
    tick();
  } else if (mode == Mode::homing) {
    tick(Request::home);
  } else {
    device.sample.position[1] = 0.01;
    tick(Request::home);
    tick();
    heal();
    tick(mode == Mode::active ? Request::enable : Request::none);
    for (int i = 0; mode == Mode::active && i < kRiseTicks; ++i) {
      device.sample.position[1] = kPressed_m + (i % 2 == 0 ? 1e-5 : 0.0);
      tick();
    }
    if (mode == Mode::fault) {  // by whichever way in is not switched off
      device.sample.status = drivers::kDeviceEncoderFault;
      tick(Request::estop);
      heal();
    }
    tick();
  }
  return controller_.mode() == mode && has_torque() == (mode == Mode::active);
}

std::string check_cell(FaultyRig& rig, const MatrixFault& fault, Mode mode,
                       std::uint64_t guards_off) {
  if (!rig.enter(mode, guards_off)) {
    return "the mode was not reached";
  }
  rig.heal();
  for (int tick = 0; tick <= fault.ticks; ++tick) {
    fault.inject(rig, tick);
    rig.tick(fault.request);
  }
  const TelemetryRecord& record = rig.record();
  if (!watches(fault, mode)) {
    const bool is_quiet = mode == Mode::fault || record.faults == 0;
    return is_quiet && (mode == Mode::active || !rig.has_torque()) ? "" : "not quiet";
  }
  if (record.mode != Mode::fault || (record.faults & fault.bit) == 0) {
    return "not latched";
  }
  if (rig.has_torque()) {
    return "torque stays";
  }
  rig.heal();
  rig.tick();
  if ((rig.record().faults & fault.bit) == 0 || rig.has_torque()) {
    return "gone by itself";
  }
  return check_recovery(rig);
}

}  // namespace tactus::firmware
