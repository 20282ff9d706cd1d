// The part of Cia402Can that sends frames: SYNC, heartbeat, the bring-up and the torque.
#include <algorithm>
#include <cmath>

#include "drivers/cia402_can/cia402_can.h"
#include "drivers/cia402_can/error_codes.h"
#include "drivers/common/seconds.h"

namespace tactus::drivers {

namespace {

using canopen::NmtCommand;
using cia402::PowerState;

constexpr double kResetEvery_s = 1.0;  // finds a drive that is switched on later
constexpr double kStartEvery_s = 0.1;
constexpr double kHeartbeatsPerWatchdog = 4.0;
constexpr double kFaultResetEdge_s = 0.02;  // the fault reset bit stays low and high for so long
constexpr double kUnitsPerTorque = 1e3;     // of the rated torque

}  // namespace

void Cia402Can::request(hal::TimeNs now_ns, CanOutbox& outbox) {
  tick_.now_ns = now_ns;
  if (stage_.phase == Phase::off) {
    return;
  }
  watch();
  faults_.show();  // the sample of this read has the whole status
  tick_.is_over = false;
  tick_.sync_ns = now_ns;
  ++tick_.unanswered_syncs;
  if (config_.leads_bus) {
    outbox.add(canopen::sync_frame());
  }
}

void Cia402Can::command(hal::TimeNs now_ns, const AxisCommand& command, CanOutbox& outbox) {
  tick_.now_ns = now_ns;
  if (stage_.phase == Phase::off) {
    return;
  }
  watch();
  if (command.power_off && (stage_.phase == Phase::powering || is_silent())) {
    start_again();
  }
  if (!faults_) {
    bring_up(command, outbox);
  }
  if (!is_silent()) {
    if (is_live()) {
      outbox.add(cia402::command_frame(config_.node, next_command(command)));
    }
    feed_watchdog(outbox);
  }
  cut_power(outbox);
  read_error_code(outbox);
  tick_.is_over = true;
}

// Takes the power away. A drive that is no longer operational takes no PDO; the SDO still acts on
// it.
void Cia402Can::cut_power(CanOutbox& outbox) {
  if (faults_ && is_live() && reports_.is_pre_operational && !session_.is_cut_off) {
    session_.is_cut_off = outbox.add(cia402::disable_voltage_frame(config_.node));
  }
}

// Sends the heartbeat behind the torque, so that it shows that a whole tick was completed.
void Cia402Can::feed_watchdog(CanOutbox& outbox) {
  const double every_s = 1e-3 * config_.watchdog_ms / kHeartbeatsPerWatchdog;
  if (host_heartbeat_.is_due(every_s, tick_.now_ns)) {
    const bool was_sent = outbox.add(canopen::heartbeat_frame(
        static_cast<std::uint8_t>(heartbeat_node(config_)), canopen::NmtState::operational));
    host_heartbeat_.tried(was_sent, tick_.now_ns);
  }
}

void Cia402Can::bring_up(const AxisCommand& command, CanOutbox& outbox) {
  switch (stage_.phase) {
    case Phase::booting:
      boot(outbox);
      return;
    case Phase::setting_up:
      run_set_up(outbox);
      return;
    case Phase::starting:
      repeat_nmt(NmtCommand::start, kStartEvery_s, outbox);
      if (reports_.running.is_operational && reports_.running.has_state) {
        enter(Phase::choosing_mode);
      }
      return;
    case Phase::choosing_mode:
      choose_mode(outbox);
      return;
    case Phase::clearing:
      clear_drive(command);
      return;
    case Phase::powering:
      if (session_.power.is_granted()) {
        enter(Phase::proving);
      }
      return;
    case Phase::proving:
      prove(outbox);
      return;
    case Phase::off:
    case Phase::ready:
      return;
  }
}

// Leaves the phase once the drive is ready to switch on. While the power is to be off the drive
// gets none for the proof, which waits however long that takes.
void Cia402Can::clear_drive(const AxisCommand& command) {
  if (cia402::power_state(reports_.state.statusword) != PowerState::ready_to_switch_on) {
    return;
  }
  reports_.emergency_code = 0;
  if (known_.is_proven || config_.unproven_watchdog) {
    enter(Phase::ready);
  } else if (command.power_off) {
    session_.begun_ns = tick_.now_ns;
  } else {
    host_heartbeat_.restart();  // the drive watches from the first one that it receives
    enter(Phase::powering);
  }
}

// Starts the bring-up. A drive whose position is followed is not reset, because its boot-up would
// hide a restart of its own.
void Cia402Can::boot(CanOutbox& outbox) {
  if (!known_.is_followed) {
    repeat_nmt(NmtCommand::reset_communication, kResetEvery_s, outbox);
  } else if (reports_.is_pre_operational) {
    objects_.begin_set_up();
    enter(Phase::setting_up);
  } else {
    repeat_nmt(NmtCommand::enter_pre_operational, kStartEvery_s, outbox);
  }
}

void Cia402Can::repeat_nmt(NmtCommand command, double every_s, CanOutbox& outbox) {
  if (stage_.nmt.is_due(every_s, tick_.now_ns)) {
    stage_.nmt.tried(outbox.add(canopen::nmt_frame(command, config_.node)), tick_.now_ns);
  }
}

void Cia402Can::run_set_up(CanOutbox& outbox) {
  if (is_done(objects_.set_up(config_, tick_.now_ns, outbox))) {
    sample_.resume();
    enter(Phase::starting);
  }
}

void Cia402Can::choose_mode(CanOutbox& outbox) {
  if (!objects_.mode_is_set()) {
    is_done(objects_.choose_torque_mode(config_, tick_.now_ns, outbox));
  } else if (reports_.running.in_torque_mode) {
    enter(Phase::clearing);
  }
}

// Latches the failure of a step. Returns true if the steps are done.
bool Cia402Can::is_done(const cia402::DriveObjects::Progress& progress) {
  if (!progress) {
    latch(progress.error().status, progress.error().trouble);
  }
  return progress.value_or(false);
}

// Asks for the error code after a fault that came without an emergency message.
void Cia402Can::read_error_code(CanOutbox& outbox) {
  if (!session_.reads_error_code) {
    return;
  }
  const auto value = objects_.read(cia402::kErrorCodeObject, tick_.now_ns, outbox);
  if (objects_.is_asking()) {
    return;
  }
  const auto code = static_cast<std::uint16_t>(value.value_or(0) & 0xFFFFU);
  if (code != 0) {
    latch_error(code);
    faults_.explain(cia402::error_code_trouble(code));
  }
  session_.reads_error_code = false;
}

cia402::TorqueCommand Cia402Can::next_command(const AxisCommand& command) {
  if (faults_) {
    return {};
  }
  switch (stage_.phase) {
    case Phase::clearing:
      return {clearing_controlword(), 0};
    case Phase::powering:
      return powered_command({.torque_Nm = 0.0, .enable = true});
    case Phase::ready:
      return powered_command(command);
    default:
      return {};
  }
}

std::uint16_t Cia402Can::clearing_controlword() const {
  const PowerState power = cia402::power_state(reports_.state.statusword);
  if (power != PowerState::fault) {
    return cia402::controlword_toward(power, false);
  }
  const hal::TimeNs edge_ns = ns_of(kFaultResetEdge_s);
  return (tick_.now_ns - stage_.begun_ns) / edge_ns % 2 == 0 ? cia402::kDisableVoltage
                                                             : cia402::kFaultReset;
}

cia402::TorqueCommand Cia402Can::powered_command(const AxisCommand& command) {
  const PowerState power = cia402::power_state(reports_.state.statusword);
  if (!command.enable) {
    session_.power.close();
    return {cia402::controlword_toward(power, false), 0};
  }
  session_.power.open(tick_.now_ns);
  if (power == PowerState::operation_enabled) {
    session_.power.note_power(tick_.now_ns);
    return {cia402::kEnableOperation, torque_units(command.torque_Nm)};
  }
  if (session_.power.is_older_than(config_.enable_timeout_s, tick_.now_ns)) {
    latch(kDeviceDriveFault,
          {cia402::power_state_words(power),
           "switch motor power on, close safe torque off and the enable input, then reset",
           reports_.state.statusword});
    return {};
  }
  return {cia402::controlword_toward(power, true), 0};
}

// Returns the torque in the drive's units. NaN gives zero.
std::int16_t Cia402Can::torque_units(double torque_Nm) const {
  const double units = kUnitsPerTorque * torque_Nm / objects_.facts().rated_torque_Nm;
  if (!std::isfinite(units)) {
    return 0;
  }
  const double limit = objects_.facts().torque_limit;
  return static_cast<std::int16_t>(std::lround(std::clamp(units, -limit, limit)));
}

}  // namespace tactus::drivers
