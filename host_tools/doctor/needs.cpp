#include "host_tools/doctor/needs.h"

#include <algorithm>
#include <span>
#include <variant>

namespace tactus::host {

namespace {

// What the drivers' README files ask for: three axes at 1 kHz fill most of 1 Mbit/s.
constexpr const char* kClassic = "bitrate 1000000";
constexpr const char* kFd =
    "bitrate 1000000 dbitrate 5000000 sample-point 0.666 dsample-point 0.666 fd on";

CanNeed need_of(const firmware::DeviceConfig& config, std::size_t connection,
                const firmware::CanConnection& can) {
  const auto axes = std::span(config.axes).first(config.axis_count);
  const bool fd = std::ranges::any_of(axes, [&](const firmware::AxisConfig& axis) {
    return axis.connection == connection &&
           std::get_if<drivers::MoteusConfig>(&axis.drive) != nullptr;
  });
  return {.interface = std::string(can.interface), .fd = fd, .set_up = fd ? kFd : kClassic};
}

}  // namespace

Needs needs_of(const firmware::DeviceConfig& config) {
  Needs needs;
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
