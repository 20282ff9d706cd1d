#include "host_tools/cli/commission_verb.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/device_file/board_firmware.h"
#include "host_tools/bake/device/certificate_file.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/certify/certified_device.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/commission/board_bench.h"
#include "host_tools/commission/commission.h"
#include "host_tools/commission/commission_report.h"
#include "host_tools/commission/simulated_bench.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kCommissionExamples =
    "Checks, joint by joint and with gentle pulses, that motors and encoders turn the way that "
    "device.toml says, at the\n"
    "scale that it says: sign, inertia, friction, delay, travel, and reported torque where the "
    "drive has one. Writes\n"
    "arm.commissioning.toml beside arm.toml; bake takes it in, and tactusd gives no force without "
    "it. What the device\n"
    "weighs at the handle is [plant] moving_mass_kg. host_tools/commission/README.md says what is "
    "measured and how.\n"
    "Exit code: 0 every joint passed, 1 one did not, 2 it could not be tried.\n"
    "\n"
    "Examples:\n"
    "  tactus commission arm.toml && tactus bake arm.toml    the real device, as root; asks you "
    "for each step\n"
    "  tactus commission arm.toml --simulated                a rehearsal; writes nothing\n"
    "  tactus commission arm.toml --unattended --travel-s 8  asks nobody: for test rigs\n"
    "  tactus commission arm.toml --simulated --json | jq '.joints[] | {name, verdict}'";

constexpr int kFailed = 1;

// The verb's options as the user gave them.
struct CommissionOptions {
  std::string device;
  bool simulated = false;
  bool json = false;
  BoardBenchOptions bench;
};

// Returns the firmware image for a Falcon; empty if the device has none.
std::vector<std::byte> falcon_firmware_of(const firmware::DeviceConfig& config) {
  const std::string_view file = firmware::board_firmware_file(config);
  if (file.empty()) {
    return {};
  }
  const std::string text = read_file(std::string(file));
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// Returns the mass at the handle: the file's, or that of the simulated device with this mechanism.
double mass_of(const firmware::DeviceConfig& config) {
  return config.plant.moving_mass_kg
             ? *config.plant.moving_mass_kg
             : certified_device(config).places.front().contact.device.plant.moving_mass_kg;
}

// Returns the real device, or the simulated one for a rehearsal.
std::unique_ptr<Bench> bench_for(const CommissionOptions& options,
                                 const firmware::DeviceConfig& config,
                                 std::span<const std::byte> falcon_firmware) {
  if (!options.simulated) {
    return open_board_bench(config, falcon_firmware, options.bench);
  }
  const WallContact middle = certified_device(config).places.front().contact;
  return std::make_unique<SimulatedBench>(middle.device, config.controller.rate_hz, middle.point_B);
}

CommissionReport run_trials(const CommissionOptions& options,
                            const firmware::DeviceConfig& config) {
  CommissionPlan plan{
      .controller = config.controller, .joints = {}, .moving_mass_kg = mass_of(config)};
  for (const firmware::JointConfig& joint : std::span(config.joints).first(config.joint_count)) {
    plan.joints.emplace_back(joint.name);
  }
  const std::vector<std::byte> firmware = falcon_firmware_of(config);
  const std::unique_ptr<Bench> bench = bench_for(options, config, firmware);
  std::optional<ProgressLine> progress;
  return commission(*bench, plan, [&](std::string_view step) {
    if (::isatty(STDERR_FILENO) == 1) {
      // A new line for each step: its clock starts at zero.
      progress.emplace().step(step);
    } else {
      fmt::print(stderr, "{}\n", step);
    }
  });
}

int run(const CommissionOptions& options) {
  if (!describes_device(options.device)) {
    throw InputError(
        fmt::format("{}: is no device, it has no [mechanism]; commission takes a "
                    "device.toml",
                    options.device));
  }
  const LoadedDevice loaded = bake_device(options.device);
  const CommissionReport report = run_trials(options, loaded.config());
  fmt::print("{}", options.json ? report_json(report) : report_text(report));
  if (!options.simulated) {
    const std::filesystem::path file = commissioning_path(options.device);
    write_commissioning(file, report, "tactus commission, on the device",
                        loaded.all_settings_checksum());
    if (!options.json) {
      fmt::print(
          "{}{}\n", file.string(),
          report.has_passed() ? "\nnow put it into the image: tactus bake " + options.device : "");
    }
  }
  return report.has_passed() ? 0 : kFailed;
}

}  // namespace

void add_commission_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "commission", "Check a device's motors and encoders, joint by joint, before its first force");
  const auto options = std::make_shared<CommissionOptions>();
  verb->add_option("device", options->device, "Device file (TOML)")->required();
  verb->add_flag("--simulated", options->simulated,
                 "Rehearse on the simulated device; nothing is written");
  verb->add_flag("--unattended", options->bench.unattended,
                 "Ask nobody: the hand's part is over after --travel-s");
  verb->add_option("--travel-s", options->bench.travel_s,
                   "With --unattended: how long the hand moves the handle everywhere")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->add_option("--priority", options->bench.priority, "SCHED_FIFO priority of the loop")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
  verb->add_flag("--json", options->json, "Print the result as one JSON object");
  verb->footer(kCommissionExamples);
  verb->callback([options] {
    if (const int code = run(*options); code != 0) {
      throw CLI::RuntimeError(code);
    }
  });
}

}  // namespace tactus::host
