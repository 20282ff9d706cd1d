#include "firmware/device_file/device_checks.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <variant>

#include "firmware/device_file/axis_visit.h"
#include "firmware/device_file/bus_settings.h"
#include "firmware/device_file/motor_stop.h"

namespace tactus::firmware {
namespace {

using drivers::Checked;
using drivers::FieldError;

// Checks the settings in which the drives of each connection must agree.
Checked check_shared_buses(const DeviceConfig& device) {
  const std::array devices{&device};
  Checked checked;
  for (std::size_t i = 0; i < device.connection_count && checked; ++i) {
    checked = check_bus_settings(devices, [i](const DeviceConfig& /*device*/,
                                              std::size_t connection) { return connection == i; });
  }
  return checked;
}

// Refuses a motor that nothing stops, and says how its driver or its connection can.
Verdict refuse_motor(const DeviceConfig& device, std::size_t motor, Words& words) {
  const AxisConfig& axis = device.axes[motor];
  const bool can_have_heartbeat = drivers::visit_drive(
      axis.drive,
      [](const auto& driver, const auto& /*drive*/) { return driver.has_heartbeat != nullptr; });
  const bool board_accepts = drivers::visit_connection(
      device.connections[axis.connection].line, [](const auto& kind, const auto& /*line*/) {
        return kind.accepts_unproven_watchdog != nullptr;
      });
  words.clear();
  words
      .add(can_have_heartbeat ? "needs a heartbeat line: nothing stops the motor of axis \""
                              : "needs a watchdog_line: nothing stops the motor of axis \"")
      .add(axis.name)
      .add("\" when the host dies, which would then keep its torque. ")
      .add(can_have_heartbeat
               ? "Wire a monostable or charge pump that gates the bridge to a line and write "
                 "heartbeat = \"LINE\" at the axis, or wire a circuit that cuts the motors' "
                 "supply"
               : "Wire a circuit that cuts the motors' supply to a GPIO line")
      .add(
          " and write watchdog_chip and watchdog_line at the top of the file; or accept the "
          "danger with "
          "unproven_watchdog = true at the ")
      .add(board_accepts ? "connection" : "axis");
  return std::unexpected(board_accepts
                             ? Refusal{Place::connection, axis.connection, {}, words.view()}
                             : Refusal{Place::axis, motor, {}, words.view()});
}

}  // namespace

Checked check(const PlantConfig& plant) {
  const auto negative = [](std::optional<double> value) { return value && *value < 0.0; };
  const auto not_positive = [](std::optional<double> value) { return value && *value <= 0.0; };
  if (not_positive(plant.moving_mass_kg) || not_positive(plant.encoder_resolution) ||
      not_positive(plant.velocity_cutoff_hz)) {
    return std::unexpected(
        FieldError{{}, "the mass, the encoder's resolution and the cut-off must be above 0"});
  }
  if (negative(plant.viscous_Ns_per_m) || negative(plant.coulomb_friction) ||
      negative(plant.motor_time_constant_s) ||
      plant.breakaway_friction.value_or(0.0) < plant.coulomb_friction.value_or(0.0)) {
    return std::unexpected(
        FieldError{{},
                   "damping, friction and time constant must not be below 0, and the break-away "
                   "friction, which belongs to the other, not below the sliding one"});
  }
  if (plant.delay_ticks.value_or(0) > kMaxPlantDelay) {
    return std::unexpected(FieldError{"delay_ticks", "must be 0 to 8"});
  }
  return {};
}

Checked check_drive(const AxisConfig& axis, const DeviceConfig& device) {
  return visit_axis(
      device, axis, [&](const auto& driver, const auto& drive, const auto& connection) -> Checked {
        if (axis.encoder != EncoderKind::incremental && !driver.encoder.may_be_absolute) {
          return std::unexpected(FieldError{
              "encoder",
              "must be \"incremental\" with this driver: it counts from where it wakes up"});
        }
        return driver.check(drive, connection);
      });
}

Checked check(const DeviceConfig& device) {
  if (!drivers::lies_between(device.read_limit_s, 0.0, 0.1)) {
    return std::unexpected(FieldError{"read_limit_s", "must lie between 0 and 0.1"});
  }
  if (device.watchdog_line.has_value() == device.watchdog_chip.empty()) {
    return std::unexpected(
        FieldError{"watchdog_line", "needs its watchdog_chip, and the chip its watchdog_line"});
  }
  if (const auto shared = check_shared_buses(device); !shared) {
    return shared;
  }
  if (const auto valid = validate(device.controller); !valid) {
    return std::unexpected(FieldError{valid.error().field, "is out of the controller's range"});
  }
  return {};
}

Verdict check_motor_stops(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.joint_count; ++i) {
    const std::size_t motor = device.joints[i].motor;
    if (motor_stop(device, motor) != MotorStop::nothing ||
        accepts_unproven_watchdog(device, motor)) {
      continue;
    }
    return refuse_motor(device, motor, words);
  }
  return {};
}

Verdict check_whole(const DeviceConfig& device, Words& words) {
  for (const auto look : {check_sharing, check_rates, check_references, check_motor_stops}) {
    if (const Verdict verdict = look(device, words); !verdict) {
      return verdict;
    }
  }
  return {};
}

}  // namespace tactus::firmware
