#include "firmware/linux/tactusd/run_device.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

#include "firmware/linux/commands/telemetry_hooks.h"
#include "firmware/linux/tactusd/fault_messages.h"
#include "firmware/linux/tactusd/messages.h"
#include "firmware/linux/tactusd/run_folder.h"

namespace tactus::firmware {

bool RunDevice::load(const Options& options, std::size_t number, Controller& controller) {
  number_ = number;
  queue_.set_device(number);
  return inputs_.load(options, number, controller);
}

bool RunDevice::open_boards(const Options& options) {
  // Reading all devices may take half of a period; the other half stays for the rest of the tick.
  const double share_s =
      0.5 / config().controller.rate_hz / static_cast<double>(options.device_count);
  const double read_limit_s = std::min(config().read_limit_s, share_s);
  const auto read_limit_ns = static_cast<hal::TimeNs>(read_limit_s * 1e9);
  drivers::ComposedDevice& device = made_device_.emplace(boards_.clock(), read_limit_ns);
  device_ = &device;
  auto opened = boards_.open(config(), inputs_.falcon_firmware(), device);
  if (opened) {
    opened = boards_.open_watchdog(config(), watchdog_);
  }
  if (!opened) {
    complain(options.devices[number_], opened.error());
  }
  return opened.has_value();
}

bool RunDevice::start_telemetry(const Options& options, const Controller& controller,
                                std::span<const std::byte> scene) {
  return telemetry_.start(
      options, number_,
      {.config = controller.config(number_), .device = inputs_.device(), .scene = scene},
      config().joint_count);
}

bool RunDevice::start_commands(const Options& options, SceneStore* scenes) {
  const FolderPath folder = run_folder(options, number_);
  std::array<char, kMaxMessage + 16> path{};
  std::array<char, kMaxMessage + 16> stop_path{};
  std::snprintf(path.data(), path.size(), "%s/command.sock", folder.data());
  std::snprintf(stop_path.data(), stop_path.size(), "%s/stop.sock", folder.data());
  queue_.set_events(telemetry_events(telemetry_.sinks()));
  RunHooks hooks = telemetry_hooks(telemetry_.sinks());
  hooks.enable_refusal = inputs_.enable_refusal();
  hooks.homing_hint = inputs_.homing_hint();
  const auto started = commands_.emplace(queue_, scenes)
                           .start({.socket_path = path.data(),
                                   .stop_socket_path = stop_path.data(),
                                   .group = options.group,
                                   .stop_priority = options.priority - 1,
                                   .allow_inject = options.allow_inject,
                                   .hooks = hooks});
  if (!started) {
    const ListenError& error = started.error();
    std::fprintf(stderr, "tactusd: no commands: %s: %.*s (%s)\n", path.data(), length(error.what),
                 error.what.data(), std::strerror(error.errno_value));
  }
  return started.has_value();
}

void RunDevice::explain_fault(const Controller& controller, std::string_view name) const {
  if (controller.mode(number_) != Mode::fault) {
    return;
  }
  if (!name.empty()) {
    std::fprintf(stderr, "tactusd: %.*s is in mode fault:\n", length(name), name.data());
  }
  firmware::explain_fault(controller.record(number_).faults, *device_);
}

}  // namespace tactus::firmware
