#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "host_tools/cli/emulate_devices.h"
#include "host_tools/cli/emulate_session.h"
#include "host_tools/emulators/can_drives.h"
#include "host_tools/emulators/cia402_emulator.h"
#include "host_tools/emulators/moteus_emulator.h"
#include "host_tools/emulators/odrive_emulator.h"
#include "host_tools/emulators/vesc_emulator.h"

namespace tactus::host {
namespace {

// The options of every kind of drive; each kind reads its own and ignores the others.
struct CanDeviceOptions {
  MachineOptions machine;
  std::string interface;
  std::vector<unsigned> nodes;
  std::string firmware = "0.6";
  std::string encoder = "incremental";
  unsigned encoder_ms = 1;
  int timeout_mode = 12;
  double max_torque_Nm = 1.0;
  double counts_per_turn = 4096.0;
  double torque_constant_Nm_per_A = 0.03;
  double max_current_A = 60.0;
  unsigned pole_pairs = 7;
  double status_ms = 5.0;
  bool no_watchdog = false;
};

// Runs the drives of any kind on a CAN interface until the run ends.
void emulate_can(const CanDeviceOptions& options, const std::string& kind, bool needs_fd,
                 const MakeCanEmulator& make) {
  CanDrives drives(options.interface, options.nodes, needs_fd, options.machine.seed, make);
  if (drives.link_is_down()) {
    fmt::print(stderr, "tactus emulate: warning: {0} is down; as root: ip link set {0} up\n",
               options.interface);
  }
  const bool is_one = drives.size() == 1;
  emulate(options.machine,
          fmt::format("{} {} {} ({} {}) on {}", drives.size(), kind, is_one ? "axis" : "axes",
                      is_one ? "node" : "nodes", fmt::join(options.nodes, ", "), options.interface),
          [&](EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions) {
            drives.connect(machine, transmissions);
          });
}

void emulate_odrive(const CanDeviceOptions& options) {
  check_emulated_nodes(options.nodes, 0, 62);
  const ODriveFirmware firmware = odrive_firmware(options.firmware);
  const EmulatedEncoder encoder = emulated_encoder(options.encoder);
  emulate_can(options, "ODrive", false,
              [&](hal::CanBus& bus, std::uint32_t seed, std::uint8_t node) {
                return std::make_unique<ODriveEmulator>(
                    bus, seed,
                    ODriveEmulatorConfig{.node_id = node,
                                         .encoder = encoder,
                                         .firmware = firmware,
                                         .encoder_ms = options.encoder_ms,
                                         .max_torque_Nm = options.max_torque_Nm});
              });
}

void emulate_moteus(const CanDeviceOptions& options) {
  check_emulated_nodes(options.nodes, 1, 126);
  emulate_can(options, "moteus", true,
              [&](hal::CanBus& bus, std::uint32_t seed, std::uint8_t node) {
                return std::make_unique<MoteusEmulator>(
                    bus, seed,
                    MoteusEmulatorConfig{.servo_id = node,
                                         .timeout_mode = options.timeout_mode,
                                         .max_torque_Nm = options.max_torque_Nm});
              });
}

void emulate_cia402(const CanDeviceOptions& options) {
  check_emulated_nodes(options.nodes, 1, 127);
  const EmulatedEncoder encoder = emulated_encoder(options.encoder);
  emulate_can(options, "CiA 402", false,
              [&](hal::CanBus& bus, std::uint32_t seed, std::uint8_t node) {
                return std::make_unique<Cia402Emulator>(
                    bus, seed,
                    Cia402EmulatorConfig{
                        .node = node,
                        .encoder = encoder,
                        .counts_per_turn = options.counts_per_turn,
                        .rated_torque_Nm = options.max_torque_Nm,
                        .rated_torque = static_cast<std::uint32_t>(1e3 * options.max_torque_Nm),
                        .has_watchdog = !options.no_watchdog});
              });
}

void emulate_vesc(const CanDeviceOptions& options) {
  check_emulated_nodes(options.nodes, 0, 254);
  emulate_can(options, "VESC", false, [&](hal::CanBus& bus, std::uint32_t seed, std::uint8_t node) {
    return std::make_unique<VescEmulator>(
        bus, seed,
        VescEmulatorConfig{.vesc_id = node,
                           .torque_constant_Nm_per_A = options.torque_constant_Nm_per_A,
                           .pole_pairs = static_cast<std::uint8_t>(options.pole_pairs),
                           .max_current_A = options.max_current_A,
                           .status_period_ns = static_cast<hal::TimeNs>(1e6 * options.status_ms)});
  });
}

// A verb and its options, to add what only this kind of drive has.
struct Device {
  CLI::App& verb;
  CanDeviceOptions& options;
};

// Adds the verb of one kind of drive. The options live as long as the verb's callback, which holds
// them.
Device add_can_device(CLI::App& emulate, const char* name, const char* text,
                      const std::vector<unsigned>& nodes, void (*run)(const CanDeviceOptions&)) {
  const auto options = std::make_shared<CanDeviceOptions>();
  CLI::App* const verb = emulate.add_subcommand(name, text);
  options->machine.mechanism = "woodenhaptics";
  options->nodes = nodes;
  verb->add_option("--can", options->interface, "CAN interface, like vcan0")->required();
  verb->add_option("--nodes", options->nodes, "Addresses of the drives, from joint 0 on")
      ->delimiter(',')
      ->capture_default_str();
  add_machine_options(*verb, options->machine);
  verb->callback([options, run] {
    take_emulator_priority(options->machine);
    run(*options);
  });
  return {*verb, *options};
}

void add_positive(CLI::App& verb, const char* name, double& value, const char* text) {
  verb.add_option(name, value, text)->check(CLI::PositiveNumber)->capture_default_str();
}

void add_max_torque(const Device& device, const char* text) {
  add_positive(device.verb, "--max-torque", device.options.max_torque_Nm, text);
}

void add_encoder(const Device& device) {
  device.verb
      .add_option(
          "--encoder", device.options.encoder,
          "What its position is after power-up: incremental (0), absolute (within a turn) or "
          "multi_turn")
      ->capture_default_str();
}

}  // namespace

void add_emulated_can_devices(CLI::App& emulate) {
  const Device odrive =
      add_can_device(emulate, "odrive", "ODrive axes (CANSimple)", {0, 1, 2}, emulate_odrive);
  odrive.verb
      .add_option("--firmware", odrive.options.firmware,
                  "0.5.2, 0.5.4, 0.5.6 or 0.6, as it behaves")
      ->capture_default_str();
  add_encoder(odrive);
  odrive.verb
      .add_option("--encoder-ms", odrive.options.encoder_ms,
                  "can.encoder_msg_rate_ms: how often positions come; 0: when asked")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  add_max_torque(odrive, "What the motor can do, N m at its shaft");

  const Device moteus = add_can_device(emulate, "moteus", "moteus servos (CAN FD, registers)",
                                       {1, 2, 3}, emulate_moteus);
  add_max_torque(moteus, "What the motor can do, N m at its shaft");
  moteus.verb
      .add_option("--timeout-mode", moteus.options.timeout_mode,
                  "servo.timeout_mode: 12, as delivered, brakes; 0 lets go")
      ->check(CLI::IsMember({0, 12}))
      ->capture_default_str();

  const Device cia402 = add_can_device(emulate, "cia402", "CANopen drives with the CiA 402 profile",
                                       {1, 2, 3}, emulate_cia402);
  add_max_torque(cia402, "The rated torque, N m; object 6076:00 has it in mN m");
  add_positive(cia402.verb, "--counts", cia402.options.counts_per_turn,
               "Encoder counts a turn of the shaft");
  add_encoder(cia402);
  cia402.verb.add_flag("--no-watchdog", cia402.options.no_watchdog,
                       "Takes object 1016 and does not heed it");

  const Device vesc =
      add_can_device(emulate, "vesc", "VESC motor controllers", {0, 1, 2}, emulate_vesc);
  add_positive(vesc.verb, "--torque-constant", vesc.options.torque_constant_Nm_per_A, "N m/A");
  add_positive(vesc.verb, "--max-current", vesc.options.max_current_A, "A");
  vesc.verb.add_option("--pole-pairs", vesc.options.pole_pairs, "Of the motor")
      ->check(CLI::Range(1, 60))
      ->capture_default_str();
  add_positive(vesc.verb, "--status-ms", vesc.options.status_ms,
               "How often the status messages come");
}

}  // namespace tactus::host
