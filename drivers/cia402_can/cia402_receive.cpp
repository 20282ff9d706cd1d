// The part of Cia402Can that takes the drive's frames, and detects missing ones.
#include <algorithm>

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
  if (stage_.phase == Phase::off || received.kind != hal::CanReceived::Kind::frame) {
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
    reports_.heartbeat_ns = std::max(tick_.now_ns, received.time_ns);
    take_heartbeat(*heartbeat);
  } else if (const auto emergency = canopen::emergency_of(frame, config_.node)) {
    take_emergency(*emergency);
  } else {
    objects_.take(frame);
  }
}

// Takes a TPDO1. Its position was measured at the last SYNC.
void Cia402Can::take_state(const cia402::DriveState& state) {
  reports_.state = state;
  reports_.running.has_state = true;
  if (!sample_.take_position(state.position, tick_.sync_ns)) {
    lose_reference(kDeviceEncoderFault,
                   {"drive reports a position that its shaft cannot have reached (6064:00)",
                    "check the encoder's cable and shield, and max_speed_rad_per_s, then reset",
                    static_cast<std::uint32_t>(state.position)});
    return;
  }
  tick_.is_late = tick_.is_over;
  if (!tick_.is_late || stage_.phase != Phase::ready) {
    take_sample();
  }
  const PowerState power = cia402::power_state(state.statusword);
  // The drive has this state after a boot only.
  if (known_.is_followed && power == PowerState::not_ready_to_switch_on) {
    lose_reference(kDeviceDriveFault, kRestarted);
  }
  check_power();
  update_status();
}

// Puts the newest state into the sample. The caller leaves out a state that comes after its tick,
// since the next tick waits for its own.
void Cia402Can::take_sample() {
  sample_.show(kTorquePerUnit * objects_.facts().rated_torque_Nm * reports_.state.torque,
               tick_.sync_ns);
  tick_.unanswered_syncs = 0;
}

void Cia402Can::check_power() {
  const PowerState power = cia402::power_state(reports_.state.statusword);
  if (is_silent()) {
    take_power_in_proof(reports_.state.statusword);
    return;
  }
  if ((stage_.phase != Phase::ready && stage_.phase != Phase::powering) || faults_) {
    return;
  }
  const bool has_supply = (reports_.state.statusword & cia402::kVoltageEnabled) != 0;
  if (is_fault(power)) {
    latch_drive_fault();
  } else if (session_.power.had_supply() && !has_supply) {
    latch_missing_supply();
  } else if (session_.power.is_granted() && power != PowerState::operation_enabled) {
    latch(kDeviceDriveFault,
          {cia402::power_state_words(power),
           "check motor power, safe torque off and the drive's inputs, then reset",
           reports_.state.statusword});
  }
  if (power == PowerState::operation_enabled && has_supply) {
    session_.power.note_supply();
  }
}

void Cia402Can::latch_drive_fault() {
  if (reports_.emergency_code != 0) {
    latch_error(reports_.emergency_code);
    return;
  }
  latch(kDeviceDriveFault, kUnnamedFault);
  session_.reads_error_code = true;
}

void Cia402Can::latch_missing_supply() {
  latch(kDeviceDriveFault,
        {"the motor's supply is gone (6041:00, voltage enabled)",
         "check motor power and the emergency stop, then reset", reports_.state.statusword});
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
  reports_.running.in_torque_mode = motion.mode == cia402::kCyclicSynchronousTorque;
  if (!sample_.take_velocity(motion.velocity)) {
    latch(kDeviceEncoderFault,
          {"drive reports a speed that its shaft cannot have (606C:00)",
           "check the encoder's cable, velocity_unit_rad_per_s and max_speed_rad_per_s, then reset",
           static_cast<std::uint32_t>(motion.velocity)});
  }
  if (!reports_.running.in_torque_mode && stage_.phase > Phase::choosing_mode && !faults_) {
    latch(kDeviceDriveFault, {"drive left cyclic synchronous torque mode (6061:00)",
                              "look for a second master on the bus, then reset",
                              static_cast<std::uint32_t>(motion.mode)});
  }
}

void Cia402Can::take_heartbeat(NmtState state) {
  reports_.running.is_operational = state == NmtState::operational;
  reports_.is_pre_operational = state == NmtState::pre_operational;
  if (state == NmtState::boot_up && known_.is_followed) {
    lose_reference(kDeviceDriveFault, kRestarted);
    return;
  }
  if (stage_.phase == Phase::booting || stage_.phase == Phase::setting_up) {
    if (state == NmtState::boot_up &&
        (stage_.phase == Phase::setting_up || stage_.nmt.has_sent())) {
      objects_.begin_set_up();
      enter(Phase::setting_up);
    }
    return;
  }
  if (state == NmtState::boot_up) {
    latch(kDeviceDriveFault, kRestarted);
  } else if (!reports_.running.is_operational && stage_.phase > Phase::starting && !is_silent()) {
    leave_operational(state);
  }
}

// Leaving operational without an earlier error looks like a restart whose boot-up message was lost.
void Cia402Can::leave_operational(NmtState state) {
  const Trouble trouble{"drive left the state 'operational' by itself",
                        "look for a second master on the bus and for bus errors, then reset",
                        static_cast<std::uint32_t>(state)};
  if (faults_ || reports_.emergency_code != 0) {
    latch(kDeviceDriveFault, trouble);
  } else {
    lose_reference(kDeviceDriveFault, trouble);
  }
}

// An emergency message during the bring-up is mostly the fault that the bring-up clears.
void Cia402Can::take_emergency(const canopen::Emergency& emergency) {
  reports_.emergency_code = emergency.code;
  if (is_silent()) {
    stage_.was_told_why = stage_.was_told_why || cia402::is_host_silent(emergency.code);
    return;
  }
  if (known_.is_followed && cia402::may_move_zero(emergency.code)) {
    latch_error(emergency.code);
  }
  if (emergency.code == 0 || stage_.phase != Phase::ready) {
    return;
  }
  if (session_.reads_error_code) {
    session_.reads_error_code = false;
    faults_.explain(cia402::error_code_trouble(emergency.code));
  }
  latch_error(emergency.code);
}

void Cia402Can::watch() {
  watch_heartbeat();
  if (faults_) {
    return;
  }
  if (stage_.phase != Phase::ready &&
      has_passed_since(session_.begun_ns, config_.bring_up_timeout_s)) {
    const bool is_lost = stage_.phase <= Phase::starting;
    latch(is_lost ? kDeviceLost : kDeviceDriveFault, late_bring_up());
    session_.reads_error_code = stage_.phase == Phase::clearing && reports_.emergency_code == 0 &&
                                is_fault(cia402::power_state(reports_.state.statusword));
  } else if (stage_.phase == Phase::ready) {
    watch_samples();
  } else if (stage_.phase == Phase::proving) {
    watch_proof();
  }
}

// Watches the heartbeat while the position is followed: in every phase, and after a fault too. A
// drive that loses its supply falls silent first.
void Cia402Can::watch_heartbeat() {
  if (known_.is_followed &&
      has_passed_since(reports_.heartbeat_ns,
                       kMissedHeartbeats * kSecondsPerMs * config_.drive_heartbeat_ms)) {
    lose_reference(kDeviceLost, {"drive sends no heartbeat any more",
                                 "check its power and the cable, then reset", 0});
  }
}

// Watches the samples. If the host missed its ticks it asked for no samples, and the drive is not
// to blame.
void Cia402Can::watch_samples() {
  if (tick_.unanswered_syncs > 1 && has_passed_since(sample().time_ns, config_.lost_after_s)) {
    lose_reference(
        kDeviceLost,
        tick_.is_late
            ? Trouble{"drive's samples come later than the tick waits for them",
                      "lower the load of the bus or let the tick wait longer, then reset", 0}
            : Trouble{"drive sends no samples any more",
                      "check its power and the cable, then reset", 0});
  }
}

Trouble Cia402Can::late_bring_up() const {
  switch (stage_.phase) {
    case Phase::booting:
      return {"drive does not boot up",
              "check its power, node number, bit rate and cable, then reset", config_.node};
    case Phase::setting_up:
      return {"drive's set-up takes too long", "lower the load of the bus, then reset", 0};
    case Phase::starting:
      return reports_.running.is_operational
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
  const PowerState power = cia402::power_state(reports_.state.statusword);
  if (is_fault(power) && reports_.emergency_code != 0) {
    return cia402::error_code_trouble(reports_.emergency_code);
  }
  return {cia402::power_state_words(power),
          "switch motor power on, close safe torque off, remove the cause, then reset",
          reports_.state.statusword};
}

}  // namespace tactus::drivers
