// The part of ODriveCan that takes the frames of the drive.

#include <cmath>
#include <utility>

#include "drivers/common/seconds.h"
#include "drivers/odrive_can/odrive_can.h"
#include "drivers/odrive_can/odrive_errors.h"

namespace tactus::drivers {

namespace {

// The drive may reach closed loop for a moment and leave it again. Two heartbeats must show it, so
// far apart and with no other state between them.
constexpr double kClosedHold_s = 0.15;
// The first heartbeat after a request may still report an earlier procedure.
constexpr std::uint32_t kClosedLoopRefusals = 2;

// The most attempts to prove the watchdog. The other axis of a 0.5 board may clear the error before
// a heartbeat reports it.
constexpr std::uint32_t kMostProofs = 3;

bool loses_reference(odrive::Generation generation, std::uint32_t error) {
  return generation == odrive::Generation::v0_6 ? odrive::loses_reference_0_6(error)
                                                : odrive::loses_reference_0_5(error);
}

bool is_watchdog(odrive::Generation generation, std::uint32_t error) {
  return generation == odrive::Generation::v0_6 ? odrive::is_watchdog_0_6(error)
                                                : odrive::is_watchdog_0_5(error);
}

bool is_state(const odrive::Heartbeat& heartbeat, odrive::AxisState state) {
  return heartbeat.state == static_cast<std::uint8_t>(state);
}

}  // namespace

void ODriveCan::take(const hal::CanReceived& received) {
  const hal::CanFrame& frame = received.frame;
  if (received.kind != hal::CanReceived::Kind::frame || frame.fd || frame.extended ||
      frame.remote || odrive::node_of(frame.id) != config_.node_id || stage_.phase == Phase::off) {
    return;
  }
  if (frame.length != hal::kMaxCanBytes) {
    ++session_.readings.malformed;
    return;
  }
  switch (odrive::command_of(frame.id)) {
    case odrive::Command::heartbeat:
      if (const auto heartbeat = odrive::read_heartbeat(frame)) {
        take_heartbeat(*heartbeat, received.time_ns);
      }
      return;
    case odrive::Command::get_estimates:
      if (const auto estimates = odrive::read_estimates(frame)) {
        take_estimates(*estimates, received.time_ns);
      }
      return;
    default:
      take_reply(frame, received.time_ns);
      return;
  }
}

void ODriveCan::take_heartbeat(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns) {
  if (known_.is_followed && has_passed(config_.heartbeat_lost_s, heard_.heartbeat_ns, time_ns)) {
    fail(kDeviceLost, {"the drive's heartbeat stopped for a while",
                       "check its power and the bus's cable, then reset"});
  }
  heard_.heartbeat_ns = time_ns;
  const std::uint32_t error_before = std::exchange(session_.last_error, heartbeat.error);
  switch (stage_.phase) {
    case Phase::listening:
      enter(Phase::probing, time_ns);
      return;
    case Phase::settling:
      if (was_sent_before(time_ns) && heartbeat.error == 0 &&
          is_state(heartbeat, odrive::AxisState::idle)) {
        enter(Phase::arming, time_ns);
      }
      return;
    case Phase::arming:
      if (was_sent_before(time_ns)) {
        take_while_arming(heartbeat, time_ns);
      }
      return;
    case Phase::up:
      if (heartbeat.error != 0) {
        fail_by_error(heartbeat.error);
      } else if (!is_state(heartbeat, odrive::AxisState::closed_loop)) {
        session_.wants_explanation = true;
        fail(kDeviceDriveFault | kDeviceReferenceLost,
             {"the drive left closed loop by itself",
              "check its supply, see dump_errors in odrivetool, then reset", heartbeat.state});
      }
      return;
    case Phase::proving:
      take_while_proving(heartbeat, time_ns);
      return;
    case Phase::resting:
      take_while_resting(heartbeat, time_ns);
      return;
    case Phase::failed:
      take_while_failed(heartbeat, error_before);
      return;
    default:
      return;
  }
}

// Takes a heartbeat in the proof: the watchdog has stopped the motor, or something else has.
void ODriveCan::take_while_proving(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns) {
  if (is_state(heartbeat, odrive::AxisState::closed_loop)) {
    return;
  }
  if (is_watchdog(session_.generation, heartbeat.error)) {
    known_.is_proven = true;
    enter(Phase::settling, time_ns);
  } else if (heartbeat.error != 0) {
    fail_by_error(heartbeat.error);
  } else if (session_.proofs < kMostProofs) {
    enter(Phase::settling, time_ns);
  } else {
    fail(kDeviceDriveFault,
         {"the drive left closed loop while its watchdog was to be proven, and does not say why",
          "see dump_errors in odrivetool, then reset"});
  }
}

void ODriveCan::take_while_resting(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns) {
  if (heartbeat.error != 0) {
    fail_by_error(heartbeat.error);
  } else if (!is_state(heartbeat, odrive::AxisState::idle) && was_sent_before(time_ns) &&
             has_passed(config_.heartbeat_lost_s, stage_.begun_ns, time_ns)) {
    fail(kDeviceDriveFault, {"the drive does not go idle", "switch its supply off, then reset"});
  }
}

// Nobody clears the error of a failed drive before clear_faults, so an error that went away is a
// restart.
void ODriveCan::take_while_failed(const odrive::Heartbeat& heartbeat, std::uint32_t error_before) {
  if (heartbeat.error == 0) {
    if (error_before != 0) {
      fail(kDeviceReferenceLost, {});
    }
  } else if (heartbeat.error != error_before) {
    fail_by_error(heartbeat.error);
  }
}

void ODriveCan::take_while_arming(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns) {
  if (heartbeat.error != 0) {
    fail_by_error(heartbeat.error);
    return;
  }
  if (is_state(heartbeat, odrive::AxisState::closed_loop)) {
    if (!known_.is_proven && !config_.unproven_watchdog) {
      enter(Phase::proving, time_ns);
      ++session_.proofs;
      return;
    }
    if (!stage_.is_closed) {
      stage_.is_closed = true;
      stage_.closed_since_ns = time_ns;
    }
    if (has_passed(kClosedHold_s, stage_.closed_since_ns, time_ns) && encoder_.is_trusted() &&
        !has_passed(config_.estimate_stale_s, heard_.estimate_ns, time_ns)) {
      enter(Phase::up, time_ns);
    }
    return;
  }
  stage_.is_closed = false;
  const Trouble refusal = session_.generation == odrive::Generation::v0_6
                              ? odrive::procedure_trouble(heartbeat.procedure_result)
                              : Trouble{};
  stage_.refused_in_a_row = refusal ? stage_.refused_in_a_row + 1 : 0;
  if (stage_.refused_in_a_row >= kClosedLoopRefusals) {
    session_.wants_explanation = true;
    fail(kDeviceDriveFault, refusal);
  }
}

void ODriveCan::take_estimates(const odrive::Estimates& estimates, hal::TimeNs time_ns) {
  if (stage_.phase == Phase::failed && !known_.is_followed) {
    return;
  }
  if (known_.is_followed && has_passed(config_.estimate_lost_s, heard_.estimate_ns, time_ns)) {
    fail(kDeviceLost, {"the drive's position estimates stopped for a while",
                       "check its power and the bus's cable and load, then reset"});
    return;
  }
  const EncoderVerdict verdict =
      encoder_.check(estimates.position_rad, estimates.velocity_rad_per_s, time_ns);
  if (verdict != EncoderVerdict::good) {
    encoder_.reset();
    if (known_.is_followed) {
      fail(kDeviceEncoderFault, trouble_of(verdict));
    }
    return;
  }
  heard_.estimate_ns = time_ns;
  sample_.position_rad = estimates.position_rad;
  sample_.velocity_rad_per_s = estimates.velocity_rad_per_s;
  sample_.time_ns = time_ns;
  sample_.status &= ~std::uint32_t{kDeviceStale};
}

void ODriveCan::take_reply(const hal::CanFrame& frame, hal::TimeNs time_ns) {
  using odrive::Command;
  switch (odrive::command_of(frame.id)) {
    case Command::get_version: {
      constexpr std::uint8_t kProtocol = 2;
      const auto version = odrive::read_version(frame);
      if (stage_.phase == Phase::probing && version && version->protocol == kProtocol) {
        session_.generation = odrive::Generation::v0_6;
        enter(Phase::settling, time_ns);
      }
      return;
    }
    case Command::get_bus:
      session_.readings.bus = odrive::read_bus_power(frame).value_or(session_.readings.bus);
      return;
    case Command::get_iq:
      if (const auto current = odrive::read_current(frame)) {
        session_.readings.current = *current;
        if (session_.generation == odrive::Generation::v0_5 &&
            config_.torque_constant_Nm_per_A > 0.0) {
          take_torque(config_.torque_constant_Nm_per_A * current->measured_A, time_ns);
        }
      }
      return;
    default:
      break;
  }
  // The meaning of the other commands depends on the generation.
  if (session_.generation == odrive::Generation::v0_5) {
    take_reply_0_5(frame);
  } else if (session_.generation == odrive::Generation::v0_6) {
    take_reply_0_6(frame, time_ns);
  }
}

void ODriveCan::take_torque(double torque_Nm, hal::TimeNs time_ns) {
  if (stage_.phase == Phase::up && std::isfinite(torque_Nm)) {
    sample_.torque_Nm = torque_Nm;
    sample_.has_torque = true;
    heard_.torque_ns = time_ns;
  }
}

void ODriveCan::take_reply_0_5(const hal::CanFrame& frame) {
  using odrive::Command;
  switch (odrive::command_of(frame.id)) {
    case Command::get_motor_error:
      if (const auto error = odrive::read_motor_error(frame); error && *error != 0) {
        explain(odrive::motor_trouble(*error), true,
                odrive::motor_loses_reference(*error) ? kDeviceReferenceLost : kDeviceOk);
      }
      return;
    case Command::get_encoder_error:
      if (const auto error = odrive::read_part_error(frame); error && *error != 0) {
        explain(odrive::encoder_trouble(*error), true, kDeviceReferenceLost);
      }
      return;
    case Command::get_controller_error:
      if (const auto error = odrive::read_part_error(frame); error && *error != 0) {
        explain(odrive::controller_trouble(*error), true,
                odrive::controller_loses_reference(*error) ? kDeviceReferenceLost : kDeviceOk);
      }
      return;
    default:
      return;
  }
}

void ODriveCan::take_reply_0_6(const hal::CanFrame& frame, hal::TimeNs time_ns) {
  using odrive::Command;
  switch (odrive::command_of(frame.id)) {
    case Command::get_error:
      if (const auto errors = odrive::read_errors(frame)) {
        const std::uint32_t error = errors->active != 0 ? errors->active : errors->disarm_reason;
        if (error != 0) {
          explain(odrive::active_trouble(error), errors->active != 0,
                  odrive::loses_reference_0_6(error) ? kDeviceReferenceLost : kDeviceOk);
          if (stage_.phase == Phase::failed && odrive::is_emergency_stop_0_6(error)) {
            fail(kDeviceEmergencyStop, {});
          }
        }
      }
      return;
    case Command::get_temperature:
      session_.readings.temperature =
          odrive::read_temperature(frame).value_or(session_.readings.temperature);
      return;
    case Command::get_torques:
      if (const auto torques = odrive::read_torques(frame)) {
        take_torque(torques->estimate_Nm, time_ns);
      }
      return;
    default:
      return;
  }
}

// Latches the error of a heartbeat.
void ODriveCan::fail_by_error(std::uint32_t error) {
  const bool is_0_6 = session_.generation == odrive::Generation::v0_6;
  const bool is_emergency_stop =
      is_0_6 ? odrive::is_emergency_stop_0_6(error) : odrive::is_emergency_stop_0_5(error);
  if (stage_.phase != Phase::failed) {
    session_.wants_explanation = !is_0_6 && odrive::is_explained_elsewhere(error);
  }
  std::uint32_t status = kDeviceDriveFault;
  if (loses_reference(session_.generation, error)) {
    status |= kDeviceReferenceLost;
  }
  if (is_emergency_stop) {
    status |= kDeviceEmergencyStop;
  }
  fail(status, is_0_6 ? odrive::active_trouble(error) : odrive::axis_trouble(error));
}

// Takes an error that the drive answered. It is the cause of a fault that is latched already or, if
// it is an active error, a new fault. `status` is added to kDeviceDriveFault.
void ODriveCan::explain(const Trouble& trouble, bool is_error, std::uint32_t status) {
  if (stage_.phase == Phase::failed && session_.wants_explanation) {
    faults_.explain(trouble);
    session_.wants_explanation = false;
    fail(status, trouble);
  } else if (stage_.phase == Phase::up && is_error) {
    fail(kDeviceDriveFault | status, trouble);
  }
}

}  // namespace tactus::drivers
