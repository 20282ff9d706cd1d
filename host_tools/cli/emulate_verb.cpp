#include "host_tools/cli/emulate_verb.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/configuration/controller_config.h"
#include "host_tools/emulators/can_drives.h"
#include "host_tools/emulators/haply_emulator.h"
#include "host_tools/emulators/machine_options.h"
#include "host_tools/emulators/odrive_emulator.h"
#include "host_tools/emulators/serial_device.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kExamples =
    "Each device has its own help: tactus emulate odrive --help. What is faked and what is not, "
    "the\n"
    "columns of the truth and how to set up interfaces: host_tools/emulators/README.md.\n"
    "\n"
    "Examples (as root, for a virtual bus: modprobe vcan; ip link add dev vcan0 type vcan;\n"
    "ip link set vcan0 mtu 72; ip link set vcan0 up):\n"
    "  tactus emulate odrive --can vcan0 --nodes 0,1,2 --mechanism woodenhaptics --ratio 16,12,12\n"
    "  tactus emulate odrive --can vcan0 --hand pen --path wish.csv --truth truth.csv --seconds "
    "10\n"
    "  tactus emulate odrive --can vcan0 --fault 1:silent@3 --fault all:none@4 --realtime 60\n"
    "  tactus emulate haply --pty --mechanism haply_pantograph";

// Of one device; the others' stay as they are.
struct Options {
  MachineOptions machine;
  std::string interface;
  std::vector<unsigned> nodes;
  std::string firmware = "0.6";
  double max_torque_Nm = 1.0;
  std::string tty;
  bool pty = false;
};

using ConnectDevice =
    std::function<void(EmulatedMachine& machine, std::span<const drivers::Transmission>)>;

void show_status(const EmulatedRun& run) {
  const MachineTruth& truth = run.machine().truth();
  const double time_s = 1e-9 * static_cast<double>(truth.time_ns - run.machine().start_ns());
  fmt::print(
      stderr, "\r\x1b[K{:.1f} s  handle {:.1f} {:.1f} {:.1f} mm  motors {:.2f} {:.2f} {:.2f} N",
      time_s, 1e3 * truth.handle_p_B.x(), 1e3 * truth.handle_p_B.y(), 1e3 * truth.handle_p_B.z(),
      truth.motor_force_B.x(), truth.motor_force_B.y(), truth.motor_force_B.z());
  std::fflush(stderr);
}

void report_end(const EmulatedRun& run, const std::string& truth) {
  const EmulatedMachine& machine = run.machine();
  fmt::print("ended after {:.3f} s; the latest step was {:.3f} ms late",
             1e-9 * static_cast<double>(machine.next_step_ns() - machine.start_ns()),
             1e-6 * static_cast<double>(run.longest_delay_ns()));
  if (run.left_out_ns() > 0) {
    fmt::print("; left out {:.3f} s, for which this machine did not run the program",
               1e-9 * static_cast<double>(run.left_out_ns()));
  }
  fmt::print("\n");
  if (!truth.empty()) {
    write_truth(truth, run.truth(), machine.joints());
    fmt::print("{}: {} rows\n", truth, run.truth().size());
  }
}

// From the first line to the last.
void emulate(const MachineOptions& options, const std::string& what, const ConnectDevice& connect) {
  EmulatedMachine machine(machine_config(options), start_of_run_ns(options.run));
  connect(machine, transmissions(options, machine.joints()));
  EmulatedRun run(machine, run_config(options));
  if (!options.truth.empty()) {
    write_truth(options.truth, {}, machine.joints());  // a file that cannot be written: say so now
  }
  fmt::print("emulating {}; mechanism {}, hand {}\n", what, options.mechanism, options.hand);
  std::fflush(stdout);
  const bool is_watched = ::isatty(STDERR_FILENO) == 1;
  run_in_real_time(run, options.run, [is_watched](const EmulatedRun& now) {
    if (is_watched) {
      show_status(now);
    }
  });
  if (is_watched) {
    fmt::print(stderr, "\r\x1b[K");
  }
  report_end(run, options.truth);
}

void emulate_can(const Options& options, const std::string& kind, bool needs_fd,
                 const MakeCanEmulator& make) {
  CanDrives drives(options.interface, options.nodes, needs_fd, options.machine.seed, make);
  if (drives.link_is_down()) {
    fmt::print(stderr, "tactus emulate: warning: {0} is down; as root: ip link set {0} up\n",
               options.interface);
  }
  emulate(options.machine,
          fmt::format("{} {} ax{}s (node{} {}) on {}", drives.size(), kind,
                      drives.size() == 1 ? "i" : "e", drives.size() == 1 ? "" : "s",
                      fmt::join(options.nodes, ", "), options.interface),
          [&](EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions) {
            drives.connect(machine, transmissions);
          });
}

void check_nodes(const std::vector<unsigned>& nodes, unsigned lowest, unsigned highest) {
  for (const unsigned node : nodes) {
    if (node < lowest || node > highest) {
      throw InputError(fmt::format("--nodes: {} is no address of this drive; they go from {} to {}",
                                   node, lowest, highest));
    }
  }
}

void emulate_odrive(const Options& options) {
  check_nodes(options.nodes, 0, 62);
  const ODriveFirmware firmware = odrive_firmware(options.firmware);
  emulate_can(
      options, "ODrive " + options.firmware, false,
      [&](hal::CanBus& bus, std::uint32_t seed, std::uint8_t node) {
        return std::make_unique<ODriveEmulator>(
            bus, seed,
            ODriveEmulatorConfig{
                .node_id = node, .firmware = firmware, .max_torque_Nm = options.max_torque_Nm});
      });
}

void emulate_haply(const Options& options) {
  if (options.pty == !options.tty.empty()) {
    throw InputError("say where: either --tty /dev/ttyGS0, the tty of a USB gadget, or --pty");
  }
  SerialDevice port;
  std::string place = options.tty;
  if (options.pty) {
    place = port.open_pseudo_terminal();
  } else {
    port.open(options.tty);
  }
  HaplyEmulator board(port, options.machine.seed);
  emulate(options.machine, fmt::format("a Haply board on {}", place),
          [&](EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions) {
            for (std::size_t i = 0; i < machine.joints(); ++i) {
              machine.connect({.shaft = &board.shafts()[i],
                               .transmission = transmissions[i],
                               .set_fault = [&](EmulatorFault fault) { board.set_fault(fault); }});
            }
            machine.add_device([&](hal::TimeNs now_ns) { board.run(now_ns); });
          });
}

void add_list(CLI::App& verb, const char* name, std::vector<double>& values, const char* text) {
  verb.add_option(name, values, text)->delimiter(',');
}

void add_machine_options(CLI::App& verb, MachineOptions& machine) {
  verb.add_option("--mechanism", machine.mechanism,
                  fmt::format("{}", fmt::join(firmware::kPresetNames, ", ")))
      ->capture_default_str();
  add_list(verb, "--ratio", machine.ratios,
           "How far the shaft turns for 1 rad or 1 m of the joint: one number, or one a joint (1)");
  add_list(verb, "--direction", machine.directions,
           "1, or -1 where the joint moves against the shaft: likewise (1)");
  add_list(verb, "--offset", machine.offsets,
           "Where the joint is when its shaft is at 0, rad or m: likewise (0)");
  verb.add_option("--hand", machine.hand, "Who holds the handle: finger, pen, firm or none")
      ->capture_default_str();
  verb.add_option("--path", machine.path,
                  "Wish path of the hand (CSV: t_s,x_m,y_m,z_m), from the start of the program");
  add_list(verb, "--origin", machine.origin_m,
           "Where the path's origin is in the mechanism's frame: x,y,z in m (its middle)");
  verb.add_option("--fault", machine.faults,
                  "AXIS:KIND@SECONDS, AXIS from 0 or all; none, silent, delayed, corrupted, "
                  "erroring or unplugged, like 0:silent@3");
  verb.add_option("--seconds", machine.run.seconds, "How long; default: until it is interrupted")
      ->check(CLI::PositiveNumber);
  verb.add_option("--truth", machine.truth,
                  "Write the true state of every millisecond to this CSV file, at the end");
  verb.add_option("--seed", machine.seed, "Seed of the hand's tremor and of damaged frames")
      ->capture_default_str();
  verb.add_option("--realtime", machine.run.priority,
                  "Run at this SCHED_FIFO priority, 1 to 99 (as every program)")
      ->check(CLI::Range(1, 99));
}

// What every device shares. The options live as long as the program's command line.
CLI::App& add_device(CLI::App& verb, const char* name, const char* text, const char* mechanism,
                     const std::shared_ptr<Options>& options,
                     const std::function<void(const Options&)>& run) {
  CLI::App* const device = verb.add_subcommand(name, text);
  options->machine.mechanism = mechanism;
  add_machine_options(*device, options->machine);
  device->callback([options, run] { run(*options); });
  return *device;
}

CLI::App& add_can_device(CLI::App& verb, const char* name, const char* text,
                         const std::vector<unsigned>& nodes,
                         const std::shared_ptr<Options>& options,
                         const std::function<void(const Options&)>& run) {
  CLI::App& device = add_device(verb, name, text, "woodenhaptics", options, run);
  options->nodes = nodes;
  device.add_option("--can", options->interface, "CAN interface, like vcan0")->required();
  device.add_option("--nodes", options->nodes, "Addresses of the drives, of joint 0 on")
      ->delimiter(',')
      ->capture_default_str();
  return device;
}

}  // namespace

void add_emulate_verb(CLI::App& app) {
  CLI::App* const verb = app.add_subcommand(
      "emulate", "Play a haptic device from the other side of a real CAN, USB or serial bus");
  verb->require_subcommand(0, 1);
  verb->callback([verb] {
    if (verb->get_subcommands().empty()) {
      throw InputError("say which device: odrive, haply; see tactus emulate --help");
    }
  });
  verb->footer(kExamples);

  const auto odrive = std::make_shared<Options>();
  CLI::App& odrive_verb = add_can_device(*verb, "odrive", "ODrive axes on CAN (CANSimple)",
                                         {0, 1, 2}, odrive, emulate_odrive);
  odrive_verb
      .add_option("--firmware", odrive->firmware, "0.5.2, 0.5.4, 0.5.6 or 0.6, as it behaves")
      ->capture_default_str();
  odrive_verb
      .add_option("--max-torque", odrive->max_torque_Nm, "What the motor can do, N m at its shaft")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();

  const auto haply = std::make_shared<Options>();
  CLI::App& haply_verb = add_device(*verb, "haply", "The Haply board on a serial line",
                                    "haply_pantograph", haply, emulate_haply);
  haply_verb.add_option("--tty", haply->tty, "The device's end, like a gadget's /dev/ttyGS0");
  haply_verb.add_flag("--pty", haply->pty, "Make a pseudo-terminal and say its path");
}

}  // namespace tactus::host
