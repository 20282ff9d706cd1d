#include "host_tools/emulators/machine_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "host_tools/input_error.h"
#include "host_tools/simulation/named_device.h"
#include "host_tools/simulation/wish_path_file.h"

namespace tactus::host {
namespace {

// Returns a joint's number from a list with one for all joints or one for each. Throws InputError
// that names the option.
double for_joint(const std::vector<double>& values, std::size_t joint, std::size_t joints,
                 std::string_view option) {
  if (values.size() != 1 && values.size() != joints) {
    throw InputError(fmt::format("{}: write one number for all joints or {}, one for each; not {}",
                                 option, joints, values.size()));
  }
  return values.size() == 1 ? values.front() : values[joint];
}

// Returns the device of the file, or the preset.
NamedDevice machine_device(const MachineOptions& options) {
  return options.device_file.empty() ? named_device(options.mechanism, "--mechanism")
                                     : named_device(options.device_file, "--device-file");
}

HandParameters hand_of(const std::string& name) {
  if (name == "none") {
    return {};
  }
  const auto hand = hand_preset(name);
  if (!hand) {
    throw InputError(
        fmt::format("--hand: there is no '{}'; there are: finger, pen, firm, none", name));
  }
  return *hand;
}

}  // namespace

EmulatedMachineConfig machine_config(const MachineOptions& options) {
  EmulatedMachineConfig config;
  config.device = machine_device(options).device;
  config.hand = hand_of(options.hand);
  config.let_go_s = options.let_go_s;
  if (options.balanced) {
    config.device.device.plant.elbow_kg = 0.0;
    config.device.device.plant.handle_kg = 0.0;
  }
  if (!options.path.empty()) {
    if (options.hand == "none") {
      throw InputError("--path is a hand's wish; say whose with --hand finger, pen or firm");
    }
    config.path = read_wish_path(options.path);
  }
  config.origin_B = config.device.centre_B;
  if (!options.origin_m.empty()) {
    if (options.origin_m.size() != 3 ||
        !std::ranges::all_of(options.origin_m, [](double value) { return std::isfinite(value); })) {
      throw InputError("--origin: write three numbers in m, like 0,0.08,0.22");
    }
    config.origin_B = Vec3(options.origin_m[0], options.origin_m[1], options.origin_m[2]);
  }
  config.seed = options.seed;
  config.step_ns = options.run.step_ns;
  return config;
}

std::vector<drivers::Transmission> transmissions(const MachineOptions& options,
                                                 std::size_t joints) {
  if (!options.device_file.empty()) {
    return machine_device(options).transmissions;
  }
  std::vector<drivers::Transmission> result;
  for (std::size_t i = 0; i < joints; ++i) {
    const double ratio = for_joint(options.ratios, i, joints, "--ratio");
    const double direction = for_joint(options.directions, i, joints, "--direction");
    const double motor_direction =
        options.motor_directions.empty()
            ? direction
            : for_joint(options.motor_directions, i, joints, "--motor-direction");
    result.push_back({.motor_ratio = ratio,
                      .encoder_ratio = ratio,
                      .motor_direction = motor_direction,
                      .encoder_direction = direction,
                      .offset = for_joint(options.offsets, i, joints, "--offset")});
    if (!drivers::is_valid(result.back())) {
      throw InputError(fmt::format(
          "joint {}: --ratio must be positive, --direction 1 or -1, --offset finite", i));
    }
  }
  return result;
}

EmulatedRunConfig run_config(const MachineOptions& options) {
  constexpr hal::TimeNs kTruthPeriod_ns = 1'000'000;
  EmulatedRunConfig config;
  for (const std::string& fault : options.faults) {
    config.faults.push_back(parse_planned_fault(fault));
  }
  config.truth_period_ns = options.truth.empty() ? 0 : kTruthPeriod_ns;
  config.expected_s = options.run.seconds.value_or(config.expected_s);
  return config;
}

}  // namespace tactus::host
