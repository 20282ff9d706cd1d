#include "host_tools/doctor/needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <variant>

#include "firmware/device_file/bus_load.h"

namespace tactus::host {

namespace {

// Returns the bit timing for `ip link`. The sample points for CAN FD are those that the maker of
// moteus, the one drive here that speaks it, gives for 1 and 5 Mbit/s.
std::string set_up_words(const drivers::CanConnection& can, bool fd) {
  return fd ? fmt::format(
                  "bitrate {:.0f} dbitrate {:.0f} sample-point 0.666 dsample-point 0.666 "
                  "fd on",
                  can.bit_rate, can.data_bit_rate)
            : fmt::format("bitrate {:.0f}", can.bit_rate);
}

MotorNeed motor_of(const firmware::DeviceConfig& config, std::size_t axis) {
  MotorNeed motor{.axis = std::string(config.axes[axis].name),
                  .stop = firmware::motor_stop(config, axis),
                  .is_accepted = firmware::accepts_unproven_watchdog(config, axis)};
  drivers::visit_drive(config.axes[axis].drive, [&](const auto& driver, const auto& drive) {
    motor.advice = driver.watchdog_advice;
    motor.watchdog_s = driver.watchdog_s == nullptr ? 0.0 : driver.watchdog_s(drive);
  });
  return motor;
}

bool speaks_fd(const firmware::AxisConfig& axis) {
  return drivers::visit_drive(
      axis.drive, [](const auto& driver, const auto& /*drive*/) { return driver.can.speaks_fd; });
}

bool has_fd_drive(const firmware::DeviceConfig& config, std::size_t connection) {
  return std::ranges::any_of(std::span(config.axes).first(config.axis_count),
                             [&](const firmware::AxisConfig& axis) {
                               return axis.connection == connection && speaks_fd(axis);
                             });
}

// These add what a connection of each kind needs. `fd` is true if a drive on it speaks CAN FD.
void add_need(const drivers::CanConnection& can, bool fd, Needs& needs) {
  needs.can.push_back({.interface = std::string(can.interface),
                       .fd = fd,
                       .set_up = set_up_words(can, fd),
                       .bitrate = std::llround(can.bit_rate),
                       .data_bitrate = fd ? std::llround(can.data_bit_rate) : 0});
}
void add_need(const drivers::FalconConnection& /*falcon*/, bool /*fd*/, Needs& needs) {
  needs.falcon = true;
}
void add_need(const drivers::HaplyConnection& haply, bool /*fd*/, Needs& needs) {
  needs.serial_ports.emplace_back(haply.port);
}
void add_need(const drivers::GpioConnection& gpio, bool /*fd*/, Needs& needs) {
  needs.gpio.push_back({.chip = std::string(gpio.chip),
                        .pwm_folder = std::string(gpio.pwm_folder),
                        .counter = std::string(gpio.counter)});
}

}  // namespace

Needs needs_of(const firmware::DeviceConfig& config) {
  Needs needs;
  needs.rate_hz = config.controller.rate_hz;
  needs.tick_instructions = firmware::tick_instructions(config.controller);
  for (const firmware::JointConfig& joint : std::span(config.joints).first(config.joint_count)) {
    needs.motors.push_back(motor_of(config, joint.motor));
  }
  for (std::size_t i = 0; i < config.connection_count; ++i) {
    std::visit([&](const auto& line) { add_need(line, has_fd_drive(config, i), needs); },
               config.connections[i].line);
    if (std::holds_alternative<drivers::CanConnection>(config.connections[i].line)) {
      needs.can.back().load = firmware::bus_load(config, i);
    }
  }
  return needs;
}

}  // namespace tactus::host
