// The part of Cia402Can that takes the drive's frames, and detects missing ones.
#include <algorithm>
#include <cmath>

#include "drivers/cia402_can/cia402_can.h"
#include "drivers/cia402_can/error_codes.h"
#include "drivers/common/seconds.h"

namespace tactus::drivers {

namespace {

using canopen::NmtState;
using cia402::PowerState;

constexpr double kMissedHeartbeats = 3.0;
constexpr double kTorquePerUnit = 1e-3;  // of the rated torque
constexpr double kSecondsPerMs = 1e-3;

constexpr Trouble kUnnamedFault{"drive is in fault, with a code that it has not told",
                                "see the drive's own diagnosis, then reset", 0};

constexpr Trouble kRestarted{"drive restarted by itself",
                             "check its supply, then reset and home: its position may have changed",
                             0};

bool is_fault(PowerState state) {
  return state == PowerState::fault || state == PowerState::fault_reaction_active;
}

}  // namespace

void Cia402Can::take(const hal::CanReceived& received) {
  if (phase_ == Phase::off || received.kind != hal::CanReceived::Kind::frame) {
    return;
  }
  const hal::CanFrame& frame = received.frame;
  if (const auto state = cia402::drive_state_of(frame, config_.node)) {
    if (is_live()) {
      take_state(*state);
    }
  } else if (const auto motion = cia402::drive_motion_of(frame, config_.node)) {
    if (is_live()) {
      take_motion(*motion);
    }
  } else if (const auto heartbeat = canopen::heartbeat_of(frame, config_.node)) {
    heard_heartbeat_ns_ = std::max(now_ns_, received.time_ns);
    take_heartbeat(*heartbeat);
  } else if (const auto emergency = canopen::emergency_of(frame, config_.node)) {
    take_emergency(*emergency);
  } else {
    sdo_.take(frame);
  }
}

// Takes a TPDO1. Its position was measured at the last SYNC.
void Cia402Can::take_state(const cia402::DriveState& state) {
  state_ = state;
  has_state_ = true;
  if (!shaft_.take(state.position, sync_ns_)) {
    lose_reference(kDeviceEncoderFault,
                   {"drive reports a position that its shaft cannot have reached (6064:00)",
                    "check the encoder's cable and shield, and max_speed_rad_per_s, then reset",
                    static_cast<std::uint32_t>(state.position)});
    return;
  }
  is_late_ = tick_is_over_;
  if (!is_late_ || phase_ != Phase::ready) {
    take_sample();
  }
  const PowerState power = cia402::power_state(state.statusword);
  if (is_followed_ && power == PowerState::not_ready_to_switch_on) {  // the state after a boot only
    lose_reference(kDeviceDriveFault, kRestarted);
  }
  check_power();
  update_status();
}

// Puts the newest state into the sample. The caller leaves out a state that comes after its tick,
// since the next tick waits for its own.
void Cia402Can::take_sample() {
  sample_.time_ns = sync_ns_;
  sample_.position_rad = shaft_.position_rad();
  if (config_.velocity_unit_rad_per_s == 0.0) {
    sample_.velocity_rad_per_s = shaft_.velocity_rad_per_s();
  }
  sample_.torque_Nm = kTorquePerUnit * facts_.rated_torque_Nm * state_.torque;
  sample_.has_torque = true;
  unanswered_syncs_ = 0;
}

void Cia402Can::check_power() {
  const PowerState power = cia402::power_state(state_.statusword);
  if (is_silent()) {
    take_power_in_proof(state_.statusword);
    return;
  }
  if ((phase_ != Phase::ready && phase_ != Phase::powering) || faults_) {
    return;
  }
  const bool has_supply = (state_.statusword & cia402::kVoltageEnabled) != 0;
  if (is_fault(power)) {
    latch_drive_fault();
  } else if (wants_power_ && had_supply_ && !has_supply) {
    latch_missing_supply();
  } else if (wants_power_ && had_power_ && power != PowerState::operation_enabled) {
    latch(kDeviceDriveFault,
          {cia402::power_state_words(power),
           "check motor power, safe torque off and the drive's inputs, then reset",
           state_.statusword});
  }
  had_supply_ = had_supply_ || (power == PowerState::operation_enabled && has_supply);
}

void Cia402Can::latch_drive_fault() {
  if (emergency_code_ != 0) {
    latch_error(emergency_code_);
    return;
  }
  latch(kDeviceDriveFault, kUnnamedFault);
  reads_error_code_ = true;
}

void Cia402Can::latch_missing_supply() {
  latch(kDeviceDriveFault,
        {"the motor's supply is gone (6041:00, voltage enabled)",
         "check motor power and the emergency stop, then reset", state_.statusword});
}

void Cia402Can::latch_error(std::uint16_t code) {
  const Trouble trouble = cia402::error_code_trouble(code);
  if (cia402::may_move_zero(code)) {
    lose_reference(kDeviceDriveFault, trouble);
  } else {
    latch(kDeviceDriveFault, trouble);
  }
}

void Cia402Can::take_motion(const cia402::DriveMotion& motion) {
  in_torque_mode_ = motion.mode == cia402::kCyclicSynchronousTorque;
  if (config_.velocity_unit_rad_per_s > 0.0) {
    take_velocity(motion.velocity);
  }
  if (!in_torque_mode_ && phase_ > Phase::choosing_mode && !faults_) {
    latch(kDeviceDriveFault, {"drive left cyclic synchronous torque mode (6061:00)",
                              "look for a second master on the bus, then reset",
                              static_cast<std::uint32_t>(motion.mode)});
  }
}

void Cia402Can::take_velocity(std::int32_t velocity) {
  const double velocity_rad_per_s = config_.velocity_unit_rad_per_s * velocity;
  if (std::abs(velocity_rad_per_s) <= config_.max_speed_rad_per_s) {
    sample_.velocity_rad_per_s = velocity_rad_per_s;
    return;
  }
  latch(kDeviceEncoderFault,
        {"drive reports a speed that its shaft cannot have (606C:00)",
         "check the encoder's cable, velocity_unit_rad_per_s and max_speed_rad_per_s, then reset",
         static_cast<std::uint32_t>(velocity)});
}

void Cia402Can::take_heartbeat(NmtState state) {
  is_operational_ = state == NmtState::operational;
  is_pre_operational_ = state == NmtState::pre_operational;
  if (state == NmtState::boot_up && is_followed_) {
    lose_reference(kDeviceDriveFault, kRestarted);
    return;
  }
  if (phase_ == Phase::booting || phase_ == Phase::setting_up) {
    if (state == NmtState::boot_up && (phase_ == Phase::setting_up || has_sent_nmt_)) {
      sdo_.reset();
      enter(Phase::setting_up);
    }
    return;
  }
  if (state == NmtState::boot_up) {
    latch(kDeviceDriveFault, kRestarted);
  } else if (!is_operational_ && phase_ > Phase::starting && !is_silent()) {
    leave_operational(state);
  }
}

// Leaving operational without an earlier error looks like a restart whose boot-up message was lost.
void Cia402Can::leave_operational(NmtState state) {
  const Trouble trouble{"drive left the state 'operational' by itself",
                        "look for a second master on the bus and for bus errors, then reset",
                        static_cast<std::uint32_t>(state)};
  if (faults_ || emergency_code_ != 0) {
    latch(kDeviceDriveFault, trouble);
  } else {
    lose_reference(kDeviceDriveFault, trouble);
  }
}

// An emergency message during the bring-up is mostly the fault that the bring-up clears.
void Cia402Can::take_emergency(const canopen::Emergency& emergency) {
  emergency_code_ = emergency.code;
  if (is_silent()) {
    was_told_why_ = was_told_why_ || cia402::is_host_silent(emergency.code);
    return;
  }
  if (is_followed_ && cia402::may_move_zero(emergency.code)) {
    latch_error(emergency.code);
  }
  if (emergency.code == 0 || phase_ != Phase::ready) {
    return;
  }
  if (reads_error_code_) {
    reads_error_code_ = false;
    faults_.explain(cia402::error_code_trouble(emergency.code));
  }
  latch_error(emergency.code);
}

void Cia402Can::watch() {
  watch_heartbeat();
  if (faults_) {
    return;
  }
  if (phase_ != Phase::ready && has_passed(begun_ns_, config_.bring_up_timeout_s)) {
    const bool is_lost = phase_ <= Phase::starting;
    latch(is_lost ? kDeviceLost : kDeviceDriveFault, late_bring_up());
    reads_error_code_ = phase_ == Phase::clearing && emergency_code_ == 0 &&
                        is_fault(cia402::power_state(state_.statusword));
  } else if (phase_ == Phase::ready) {
    watch_samples();
  } else if (phase_ == Phase::proving) {
    watch_proof();
  }
}

// Watches the heartbeat while the position is followed: in every phase, and after a fault too. A
// drive that loses its supply falls silent first.
void Cia402Can::watch_heartbeat() {
  if (is_followed_ && has_passed(heard_heartbeat_ns_,
                                 kMissedHeartbeats * kSecondsPerMs * config_.drive_heartbeat_ms)) {
    lose_reference(kDeviceLost, {"drive sends no heartbeat any more",
                                 "check its power and the cable, then reset", 0});
  }
}

// Watches the samples. If the host missed its ticks it asked for no samples, and the drive is not
// to blame.
void Cia402Can::watch_samples() {
  if (unanswered_syncs_ > 1 && has_passed(sample_.time_ns, config_.lost_after_s)) {
    lose_reference(
        kDeviceLost,
        is_late_ ? Trouble{"drive's samples come later than the tick waits for them",
                           "lower the load of the bus or let the tick wait longer, then reset", 0}
                 : Trouble{"drive sends no samples any more",
                           "check its power and the cable, then reset", 0});
  }
}

Trouble Cia402Can::late_bring_up() const {
  switch (phase_) {
    case Phase::booting:
      return {"drive does not boot up",
              "check its power, node number, bit rate and cable, then reset", config_.node};
    case Phase::setting_up:
      return {"drive's set-up takes too long", "lower the load of the bus, then reset", 0};
    case Phase::starting:
      return is_operational_
                 ? Trouble{"drive is operational but sends no samples",
                           "see that one drive of the bus has leads_bus set (SYNC), then reset", 0}
                 : Trouble{"drive does not become operational",
                           "see the drive's own diagnosis, then reset", 0};
    case Phase::choosing_mode:
      return {"drive does not enter cyclic synchronous torque mode (6061:00)",
              "see the drive's own diagnosis, then reset", 0};
    default:
      break;
  }
  const PowerState power = cia402::power_state(state_.statusword);
  if (is_fault(power) && emergency_code_ != 0) {
    return cia402::error_code_trouble(emergency_code_);
  }
  return {cia402::power_state_words(power),
          "switch motor power on, close safe torque off, remove the cause, then reset",
          state_.statusword};
}

}  // namespace tactus::drivers
