#include "host_tools/cli/emulate_session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "firmware/configuration/controller_config.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Rewrites the line of the terminal that shows the running machine.
void show_status(const EmulatedRun& run) {
  const MachineTruth& truth = run.machine().truth();
  const double time_s = 1e-9 * static_cast<double>(truth.time_ns - run.machine().start_ns());
  const Vec3 handle_mm = 1e3 * truth.handle_p_B;
  const Vec3& force_N = truth.motor_force_B;
  fmt::print(stderr, "{}{:.1f} s  handle {:.1f} {:.1f} {:.1f} mm  motors {:.2f} {:.2f} {:.2f} N",
             kWipeLine, time_s, handle_mm.x(), handle_mm.y(), handle_mm.z(), force_N.x(),
             force_N.y(), force_N.z());
  std::fflush(stderr);
}

void report_end(const EmulatedRun& run, const std::string& truth) {
  const EmulatedMachine& machine = run.machine();
  fmt::print("ended after {:.3f} s; the latest step was {:.3f} ms late",
             1e-9 * static_cast<double>(machine.next_step_ns() - machine.start_ns()),
             1e-6 * static_cast<double>(run.longest_delay_ns()));
  if (run.left_out_ns() > 0) {
    fmt::print("; left out {:.3f} s, in which the program did not get to run",
               1e-9 * static_cast<double>(run.left_out_ns()));
  }
  fmt::print("\n");
  if (!truth.empty()) {
    write_truth(truth, run.truth(), machine.joints());
    fmt::print("{}: {} rows\n", truth, run.truth().size());
  }
}

void add_list(CLI::App& verb, const char* name, std::vector<double>& values, const char* text) {
  verb.add_option(name, values, text)->delimiter(',');
}

}  // namespace

void add_machine_options(CLI::App& verb, MachineOptions& machine) {
  verb.add_option("--mechanism", machine.mechanism,
                  fmt::format("{}", fmt::join(firmware::kPresetNames, ", ")))
      ->capture_default_str();
  CLI::Option* const file = verb.add_option(
      "--device-file", machine.device_file,
      "An own device, arm.toml or arm.tactus: its mechanism, ratios, directions and offsets");
  add_list(verb, "--ratio", machine.ratios,
           "How far the shaft turns for 1 rad or 1 m of the joint: one number, or one a joint (1)");
  add_list(verb, "--direction", machine.directions,
           "1, or -1 where the joint moves against the shaft: likewise (1)");
  add_list(verb, "--motor-direction", machine.motor_directions,
           "-1 where the motor alone is wired the wrong way round (as --direction)");
  add_list(verb, "--offset", machine.offsets,
           "Where the joint is when its shaft is at 0, rad or m: likewise (0)");
  for (const char* const other :
       {"--mechanism", "--ratio", "--direction", "--motor-direction", "--offset"}) {
    file->excludes(verb.get_option(other));
  }
  verb.add_option("--hand", machine.hand, "Who holds the handle: finger, pen, firm or none")
      ->capture_default_str();
  verb.add_option("--path", machine.path,
                  "Wish path of the hand (CSV: t_s,x_m,y_m,z_m), from the start of the program");
  verb.add_option("--let-go", machine.let_go_s, "When the hand leaves the handle for good, s")
      ->check(CLI::PositiveNumber);
  verb.add_flag("--balanced", machine.balanced,
                "The arm's weight is balanced: left alone it stays where it is");
  add_list(verb, "--origin", machine.origin_m,
           "Where the path's origin is in the mechanism's frame: x,y,z in m (its middle)");
  verb.add_option("--fault", machine.faults,
                  "AXIS:KIND@SECONDS, AXIS from 0 or all; none, silent, delayed, corrupted, "
                  "erroring, unplugged or power_cycled, like 0:silent@3");
  verb.add_option("--seconds", machine.run.seconds, "How long; default: until it is interrupted")
      ->check(CLI::PositiveNumber);
  verb.add_option("--truth", machine.truth,
                  "Write the true state of every millisecond to this CSV file, at the end");
  verb.add_option("--seed", machine.seed, "Seed of the hand's tremor and of damaged frames")
      ->capture_default_str();
  verb.add_option("--realtime", machine.priority,
                  "Run at this SCHED_FIFO priority, 1 to 99; default: as every program")
      ->check(CLI::Range(1, 99));
}

void take_emulator_priority(const MachineOptions& machine) {
  if (machine.priority > 0) {
    take_realtime_priority(machine.priority);
  }
}

void check_emulated_nodes(const std::vector<unsigned>& nodes, unsigned lowest, unsigned highest) {
  for (const unsigned node : nodes) {
    if (node < lowest || node > highest) {
      throw InputError(fmt::format("--nodes: {} is no address of this drive; they go from {} to {}",
                                   node, lowest, highest));
    }
  }
}

void emulate(const MachineOptions& options, const std::string& what, const ConnectDevice& connect) {
  EmulatedMachine machine(machine_config(options), start_of_run_ns(options.run));
  connect(machine, transmissions(options, machine.joints()));
  EmulatedRun run(machine, run_config(options));
  if (!options.truth.empty()) {
    // A file that cannot be written should be reported now and not after the run.
    write_truth(options.truth, {}, machine.joints());
  }
  fmt::print("emulating {}; mechanism {}, hand {}\n", what,
             options.device_file.empty() ? options.mechanism : options.device_file, options.hand);
  std::fflush(stdout);
  const bool is_watched = ::isatty(STDERR_FILENO) == 1;
  run_in_real_time(run, options.run, [is_watched](const EmulatedRun& now) {
    if (is_watched) {
      show_status(now);
    }
  });
  if (is_watched) {
    fmt::print(stderr, "{}", kWipeLine);
  }
  report_end(run, options.truth);
}

}  // namespace tactus::host
