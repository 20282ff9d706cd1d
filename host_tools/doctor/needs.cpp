#include "host_tools/doctor/needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <variant>

namespace tactus::host {

namespace {

// Returns the bit timing for `ip link`. The sample points for CAN FD are those that the maker of
// moteus, the one drive here that speaks it, gives for 1 and 5 Mbit/s.
std::string set_up_words(const firmware::CanConnection& can, bool fd) {
  return fd ? fmt::format(
                  "bitrate {:.0f} dbitrate {:.0f} sample-point 0.666 dsample-point 0.666 "
                  "fd on",
                  can.bit_rate, can.data_bit_rate)
            : fmt::format("bitrate {:.0f}", can.bit_rate);
}

// The watchdog's timeout of each kind of drive, s. Axes that the board drives have none of their
// own.
struct WatchdogOf {
  double operator()(const drivers::ODriveConfig& drive) const { return drive.watchdog_s; }
  double operator()(const drivers::MoteusConfig& drive) const { return drive.watchdog_s; }
  double operator()(const drivers::VescConfig& drive) const { return drive.watchdog_s; }
  double operator()(const drivers::Cia402Config& drive) const { return 1e-3 * drive.watchdog_ms; }
  double operator()(const drivers::GpioAxisConfig& /*axis*/) const { return 0.0; }
  double operator()(const firmware::BoardAxis& /*axis*/) const { return 0.0; }
};

MotorNeed motor_of(const firmware::DeviceConfig& config, std::size_t axis) {
  const auto& drive = config.axes[axis].drive;
  return {.axis = std::string(config.axes[axis].name),
          .stop = firmware::motor_stop(config, axis),
          .is_accepted = firmware::accepts_unproven_watchdog(config, axis),
          .is_odrive = std::holds_alternative<drivers::ODriveConfig>(drive),
          .watchdog_s = std::visit(WatchdogOf{}, drive)};
}

CanNeed need_of(const firmware::DeviceConfig& config, std::size_t connection,
                const firmware::CanConnection& can) {
  const auto axes = std::span(config.axes).first(config.axis_count);
  // moteus is the one kind of drive that speaks CAN FD.
  const bool fd = std::ranges::any_of(axes, [&](const firmware::AxisConfig& axis) {
    return axis.connection == connection &&
           std::get_if<drivers::MoteusConfig>(&axis.drive) != nullptr;
  });
  return {.interface = std::string(can.interface), .fd = fd, .set_up = set_up_words(can, fd)};
}

}  // namespace

Needs needs_of(const firmware::DeviceConfig& config) {
  Needs needs;
  for (const firmware::JointConfig& joint : std::span(config.joints).first(config.joint_count)) {
    needs.motors.push_back(motor_of(config, joint.motor));
  }
  for (std::size_t i = 0; i < config.connection_count; ++i) {
    const auto& line = config.connections[i].line;
    if (const auto* can = std::get_if<firmware::CanConnection>(&line)) {
      needs.can.push_back(need_of(config, i, *can));
    } else if (std::get_if<firmware::FalconConnection>(&line) != nullptr) {
      needs.falcon = true;
    } else if (const auto* haply = std::get_if<firmware::HaplyConnection>(&line)) {
      needs.serial_ports.emplace_back(haply->port);
    } else if (const auto* gpio = std::get_if<firmware::GpioConnection>(&line)) {
      needs.gpio.push_back({.chip = std::string(gpio->chip),
                            .pwm_folder = std::string(gpio->pwm_folder),
                            .counter = std::string(gpio->counter)});
    }
  }
  return needs;
}

}  // namespace tactus::host
