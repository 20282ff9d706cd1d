// The part of ODriveCan that takes the frames of the drive. Its heartbeats are taken in
// odrive_heartbeats.cpp.

#include <cmath>

#include "drivers/common/seconds.h"
#include "drivers/odrive_can/odrive_can.h"
#include "drivers/odrive_can/odrive_errors.h"

namespace tactus::drivers {

namespace {

bool loses_reference(odrive::Generation generation, std::uint32_t error) {
  return generation == odrive::Generation::v0_6 ? odrive::loses_reference_0_6(error)
                                                : odrive::loses_reference_0_5(error);
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
    sample_.torque_time_ns = time_ns;
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
