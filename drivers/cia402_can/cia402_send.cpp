// The part of Cia402Can that sends frames: SYNC, heartbeat, the bring-up and the torque.
#include <algorithm>
#include <cmath>

#include "drivers/cia402_can/cia402_can.h"
#include "drivers/cia402_can/error_codes.h"
#include "drivers/common/seconds.h"

namespace tactus::drivers {

namespace {

using canopen::NmtCommand;
using canopen::SdoClient;
using cia402::PowerState;

constexpr double kResetEvery_s = 1.0;  // finds a drive that is switched on later
constexpr double kStartEvery_s = 0.1;
constexpr double kHeartbeatsPerWatchdog = 4.0;
constexpr double kFaultResetEdge_s = 0.02;  // the fault reset bit stays low and high for so long
// For this time a state without power is no fault, since the drive may not have taken the last
// controlword yet.
constexpr double kPowerSettles_s = 0.01;
constexpr double kUnitsPerTorque = 1e3;  // of the rated torque

}  // namespace

void Cia402Can::request(hal::TimeNs now_ns, CanOutbox& outbox) {
  now_ns_ = now_ns;
  if (phase_ == Phase::off) {
    return;
  }
  watch();
  is_shown_ = true;  // the sample of this read has the whole status
  tick_is_over_ = false;
  sync_ns_ = now_ns;
  ++unanswered_syncs_;
  if (config_.leads_bus) {
    outbox.add(canopen::sync_frame());
  }
}

void Cia402Can::command(hal::TimeNs now_ns, const AxisCommand& command, CanOutbox& outbox) {
  now_ns_ = now_ns;
  if (phase_ == Phase::off) {
    return;
  }
  watch();
  if (command.power_off && (phase_ == Phase::powering || is_silent())) {
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
  tick_is_over_ = true;
}

// Takes the power away. A drive that is no longer operational takes no PDO; the SDO still acts on
// it.
void Cia402Can::cut_power(CanOutbox& outbox) {
  if (faults_ && is_live() && is_pre_operational_ && !is_cut_off_) {
    is_cut_off_ = outbox.add(cia402::disable_voltage_frame(config_.node));
  }
}

// Sends the heartbeat behind the torque, so that it shows that a whole tick was completed.
void Cia402Can::feed_watchdog(CanOutbox& outbox) {
  if (!has_sent_heartbeat_ ||
      has_passed(sent_heartbeat_ns_, 1e-3 * config_.watchdog_ms / kHeartbeatsPerWatchdog)) {
    has_sent_heartbeat_ = outbox.add(canopen::heartbeat_frame(
        static_cast<std::uint8_t>(heartbeat_node(config_)), canopen::NmtState::operational));
    sent_heartbeat_ns_ = now_ns_;
  }
}

void Cia402Can::bring_up(const AxisCommand& command, CanOutbox& outbox) {
  switch (phase_) {
    case Phase::booting:
      boot(outbox);
      return;
    case Phase::setting_up:
      run_set_up(outbox);
      return;
    case Phase::starting:
      repeat_nmt(NmtCommand::start, kStartEvery_s, outbox);
      if (is_operational_ && has_state_) {
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
      if (had_power_) {
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
  if (cia402::power_state(state_.statusword) != PowerState::ready_to_switch_on) {
    return;
  }
  emergency_code_ = 0;
  if (is_proven_ || config_.unproven_watchdog) {
    enter(Phase::ready);
  } else if (command.power_off) {
    begun_ns_ = now_ns_;
  } else {
    has_sent_heartbeat_ = false;  // the drive watches from the first one that it receives
    enter(Phase::powering);
  }
}

// Starts the bring-up. A drive whose position is followed is not reset, because its boot-up would
// hide a restart of its own.
void Cia402Can::boot(CanOutbox& outbox) {
  if (!is_followed_) {
    repeat_nmt(NmtCommand::reset_communication, kResetEvery_s, outbox);
  } else if (is_pre_operational_) {
    enter(Phase::setting_up);
  } else {
    repeat_nmt(NmtCommand::enter_pre_operational, kStartEvery_s, outbox);
  }
}

void Cia402Can::repeat_nmt(NmtCommand command, double every_s, CanOutbox& outbox) {
  if (!has_sent_nmt_ || has_passed(sent_nmt_ns_, every_s)) {
    has_sent_nmt_ = outbox.add(canopen::nmt_frame(command, config_.node));
    sent_nmt_ns_ = now_ns_;
  }
}

void Cia402Can::run_set_up(CanOutbox& outbox) {
  const auto steps = cia402::set_up_steps();
  while (step_ < steps.size() && run_step(steps[step_], outbox)) {
    ++step_;
  }
  if (step_ == steps.size()) {
    shaft_.resume();
    enter(Phase::starting);
  }
}

void Cia402Can::choose_mode(CanOutbox& outbox) {
  if (!mode_is_set_) {
    mode_is_set_ = run_step(cia402::torque_mode_step(), outbox);
  } else if (in_torque_mode_) {
    enter(Phase::clearing);
  }
}

// Returns true when the step is done. Otherwise it has asked, waits for an answer, or has latched
// why the step failed.
bool Cia402Can::run_step(const cia402::SdoStep& step, CanOutbox& outbox) {
  if (sdo_.state() == SdoClient::State::idle) {
    if (step.size == 0) {
      sdo_.read(step.object);
    } else {
      sdo_.write(step.object, cia402::value_to_write(step, config_, facts_), step.size);
    }
  }
  sdo_.run(now_ns_, outbox);
  const SdoClient::State state = sdo_.state();
  if (state == SdoClient::State::asking) {
    return false;
  }
  const bool is_done = state == SdoClient::State::done;
  if (!is_done &&
      (state != SdoClient::State::refused || !cia402::may_go_on_without(step, sdo_.value()))) {
    refuse(step);
    return false;
  }
  const Trouble trouble = cia402::judge(step, is_done ? sdo_.value() : 0, config_, facts_);
  sdo_.reset();
  if (trouble) {
    latch(kDeviceDriveFault, trouble);
    return false;
  }
  return true;
}

void Cia402Can::refuse(const cia402::SdoStep& step) {
  if (sdo_.state() == SdoClient::State::refused) {
    latch(kDeviceDriveFault, {step.what, canopen::sdo_abort_words(sdo_.value()), sdo_.value()});
  } else if (sdo_.state() == SdoClient::State::too_long) {
    latch(kDeviceDriveFault, {step.what,
                              "the drive's answer is longer than 4 bytes, which this driver does "
                              "not read: check the drive's type and firmware",
                              step.object.index});
  } else {
    latch(kDeviceLost,
          {step.what, "the drive does not answer: check its power and cable, then reset",
           step.object.index});
  }
  sdo_.reset();
}

// Asks for the error code after a fault that came without an emergency message.
void Cia402Can::read_error_code(CanOutbox& outbox) {
  if (!reads_error_code_) {
    return;
  }
  if (sdo_.state() == SdoClient::State::idle) {
    sdo_.read(cia402::kErrorCodeObject);
  }
  sdo_.run(now_ns_, outbox);
  if (sdo_.state() == SdoClient::State::asking) {
    return;
  }
  const auto code = static_cast<std::uint16_t>(sdo_.value() & 0xFFFFU);
  if (sdo_.state() == SdoClient::State::done && code != 0) {
    latch_error(code);
    faults_.explain(cia402::error_code_trouble(code));
  }
  reads_error_code_ = false;
  sdo_.reset();
}

cia402::TorqueCommand Cia402Can::next_command(const AxisCommand& command) {
  if (faults_) {
    return {};
  }
  switch (phase_) {
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
  const PowerState power = cia402::power_state(state_.statusword);
  if (power != PowerState::fault) {
    return cia402::controlword_toward(power, false);
  }
  const hal::TimeNs edge_ns = ns_of(kFaultResetEdge_s);
  return (now_ns_ - phase_ns_) / edge_ns % 2 == 0 ? cia402::kDisableVoltage : cia402::kFaultReset;
}

cia402::TorqueCommand Cia402Can::powered_command(const AxisCommand& command) {
  const PowerState power = cia402::power_state(state_.statusword);
  if (!command.enable) {
    wants_power_ = false;
    return {cia402::controlword_toward(power, false), 0};
  }
  if (!wants_power_) {
    wants_power_ = true;
    wants_power_ns_ = now_ns_;
    had_power_ = false;
    had_supply_ = false;
  }
  if (power == PowerState::operation_enabled) {
    had_power_ = had_power_ || has_passed(wants_power_ns_, kPowerSettles_s);
    return {cia402::kEnableOperation, torque_units(command.torque_Nm)};
  }
  if (has_passed(wants_power_ns_, config_.enable_timeout_s)) {
    latch(kDeviceDriveFault,
          {cia402::power_state_words(power),
           "switch motor power on, close safe torque off and the enable input, then reset",
           state_.statusword});
    return {};
  }
  return {cia402::controlword_toward(power, true), 0};
}

// Returns the torque in the drive's units. NaN gives zero.
std::int16_t Cia402Can::torque_units(double torque_Nm) const {
  const double units = kUnitsPerTorque * torque_Nm / facts_.rated_torque_Nm;
  if (!std::isfinite(units)) {
    return 0;
  }
  const double limit = facts_.torque_limit;
  return static_cast<std::int16_t>(std::lround(std::clamp(units, -limit, limit)));
}

}  // namespace tactus::drivers
