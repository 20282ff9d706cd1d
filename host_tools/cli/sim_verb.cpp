#include "host_tools/cli/sim_verb.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "host_tools/cli/serve_simulation.h"
#include "host_tools/cli/sim_outputs.h"
#include "host_tools/cli/simulate.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/remote/remote.h"
#include "host_tools/simulation/named_device.h"
#include "host_tools/simulation/run.h"
#include "host_tools/simulation/wish_path_file.h"

namespace tactus::host {
namespace {

constexpr const char* kSimExamples =
    "A wish path is where the hand wants to be, with header t_s,x_m,y_m,z_m; without one the hand\n"
    "presses and strokes the front of the scene for ten seconds (a device with one axis presses\n"
    "on its right side), and again and again with more --seconds. It does so in the middle, or,\n"
    "where nothing is there, on the broadest part; if it touches nothing all the same, the exit\n"
    "code is 3. The device stands so that the middle of the path is the middle of its\n"
    "workspace. The columns of the output and the "
    "devices,\n"
    "hands and faults are described in host_tools/simulation/README.md.\n"
    "\n"
    "Examples:\n"
    "  tactus sim scene.tactus --output run.csv       then: tactus plot run.csv --scene "
    "scene.tactus\n"
    "  tactus sim scene.tactus --device falcon --hand firm --seed 7 --path wish.csv\n"
    "  tactus sim scene.tactus --device arm.toml      an own device that is not built yet: tactus "
    "init arm\n"
    "  tactus sim scene.tactus --hashes a.txt && tactus sim scene.tactus --hashes b.txt && cmp "
    "a.txt b.txt\n"
    "  tactus sim scene.tactus --record run.mcap      then: tactus replay run.mcap\n"
    "  tactus sim scene.tactus --explain steps.csv    every move, plane and friction circle of "
    "every tick,\n"
    "                                                 and the times of the loop's seven steps\n"
    "  tactus sim scene.tactus --fault estop@4 --fault stale@2.5x2\n"
    "  tactus sim grasp.tactus --device falcon --device falcon --path thumb.csv --path finger.csv\n"
    "    --output run.csv --bodies bodies.csv         two devices in one world: run.csv and "
    "run.2.csv\n"
    "  tactus sim scene.tactus --seconds 600 --json | jq .simulated_s_per_s\n"
    "  tactus sim scene.tactus --serve --udp-json 9870   live curves in PlotJuggler\n"
    "  tactus sim scene.tactus --device falcon --serve --run-dir /tmp/tactus\n"
    "    then, elsewhere: export TACTUS_RUN_DIR=/tmp/tactus; tactus home --wait; tactus enable";

// The verb's options as the user gave them.
struct SimOptions {
  std::string scene;
  SimFiles files;
  bool json = false;
  // True: a recording may replace a file that is there.
  bool may_overwrite = false;
  bool serve = false;
  ServeOptions serving{.run_dir = std::string(kDefaultRunDir)};
  RunOptions run;
};

// The exit code of a run along the whole of its own path in which nothing was touched.
constexpr int kNothingTouched = 3;

// Throws InputError if an output is an input or another output, if several devices would share a
// pipe, or if a recording is there that may not be overwritten.
void check_files(const SimOptions& options, std::size_t devices) {
  const SimFiles& files = options.files;
  std::vector<std::filesystem::path> inputs(options.run.paths.begin(), options.run.paths.end());
  std::ranges::copy_if(options.run.devices, std::back_inserter(inputs), names_file);
  inputs.emplace_back(options.scene);
  std::vector<std::filesystem::path> outputs{files.bodies.places, files.bodies.energy};
  for (const std::string& file : {files.output, files.hashes, files.record, files.explain}) {
    refuse_shared_pipe(file, devices);
    for (std::size_t i = 0; i < devices; ++i) {
      outputs.push_back(file_of_tool(file, i));
    }
  }
  keep_inputs_safe(outputs, inputs);
  for (std::size_t i = 0; i < devices; ++i) {
    check_recording_place(file_of_tool(files.record, i), options.may_overwrite);
  }
}

// Prints the summaries: to standard error if the rows go to standard output.
void print(const SimOptions& options, const std::vector<RunSummary>& summaries) {
  const SimFiles& files = options.files;
  std::FILE* const out =
      is_standard_output(files.output) || is_standard_output(files.hashes) ? stderr : stdout;
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    if (summaries.size() > 1 && !options.json) {
      fmt::print(out, "device {}:\n", i + 1);
    }
    fmt::print(out, "{}", options.json ? summary_json(summaries[i]) : summary_text(summaries[i]));
  }
}

void run_sim(const SimOptions& options) {
  if (options.serve) {
    check_files(options, device_count(options.run));
    if (options.serving.udp_port + device_count(options.run) - 1 > 65535) {
      throw InputError(fmt::format("--udp-json {}: each device needs a port, up to 65535",
                                   options.serving.udp_port));
    }
    ServeOptions serving = options.serving;
    serving.record = options.files.record;
    serve_simulation(options.scene, options.run, serving);
    return;
  }
  check_files(options, device_count(options.run));
  const std::vector<RunSummary> summaries =
      simulate("sim", options.scene, options.run, options.files);
  print(options, summaries);
  const bool is_untouched =
      std::ranges::all_of(summaries, [](const RunSummary& s) { return s.contact_ticks == 0; });
  const bool is_whole = options.run.seconds.value_or(kOwnPath_s) >= kOwnPath_s;
  if (options.run.paths.empty() && is_whole && is_untouched) {
    throw CLI::RuntimeError(kNothingTouched);
  }
}

}  // namespace

void add_sim_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "sim", "Let a simulated hand and device touch a scene through the controller");
  const auto options = std::make_shared<SimOptions>();
  RunOptions& run = options->run;
  verb->add_option("scene", options->scene, "Scene image (.tactus)")->required();
  verb->add_option("--device", run.devices,
                   fmt::format("{}, or the file of an own device, arm.toml or arm.tactus; once for "
                               "each device, up to ten, or once for all",
                               fmt::join(firmware::kPresetNames, ", ")))
      ->allow_extra_args(false)
      ->capture_default_str();
  verb->add_option("--hand", run.hands,
                   "finger, pen or firm; once for each device, or once for all")
      ->allow_extra_args(false)
      ->capture_default_str();
  verb->add_option("--seed", run.seed, "Seed of the hand's tremor")->capture_default_str();
  verb->add_option("--seconds", run.seconds,
                   "How long to simulate; default: until the wish path ends");
  CLI::Option* const rate = verb->add_option(
      "--rate-hz", run.rate_hz,
      "Ticks of the controller a second, 50 to 50000 (that of a device file, else 1000)");
  verb->add_option("--compensate", run.compensated_share,
                   "Share of the joints' friction that the controller takes over, 0 to 0.9")
      ->capture_default_str();
  verb->add_option("--path", run.paths,
                   "Wish path of the hand (CSV); once for each device. One that ends leaves its "
                   "hand where it is")
      ->allow_extra_args(false);
  verb->add_option("-o,--output", options->files.output, "Write one line a tick to this CSV file");
  verb->add_option("--hashes", options->files.hashes,
                   "Write the state hash of every tick to this file");
  verb->add_option("--record", options->files.record,
                   "Record the run to this file: .mcap, for tactus replay, or .csv; one that is "
                   "there is kept");
  verb->add_flag("--overwrite", options->may_overwrite, "Let --record replace a file that is there")
      ->needs("--record");
  verb->add_option(
      "--explain", options->files.explain,
      "Write every step of every tick to this CSV file (host_tools/explain/README.md)");
  verb->add_option("--bodies", options->files.bodies.places,
                   "Write where each body is at each tick to this CSV file");
  verb->add_option("--body-energy", options->files.bodies.energy,
                   "Write the energy of each body, and the work of the hands on it, to this CSV "
                   "file");
  verb->add_option(
      "--fault", run.faults,
      "Let a device fail: stale, nan, estop or lost, like stale@2.5x3, or 2:lost@4 for "
      "the second one");
  verb->add_flag("--allow-uncertified", run.allow_uncertified,
                 "Touch a scene that is stiffer than the certificate of the device's file");
  verb->add_flag("--json", options->json, "Print the summary as one JSON object");
  CLI::Option* const serve = verb->add_flag("--serve", options->serve,
                                            "Run in wall-clock time behind the sockets of tactusd, "
                                            "until Ctrl-C: try monitor, enable, set");
  verb->add_option("--run-dir", options->serving.run_dir, "Folder of the sockets of --serve")
      ->envname("TACTUS_RUN_DIR")
      ->capture_default_str();
  verb->add_flag("--allow-inject", options->serving.allow_inject,
                 "Let tactus inject raise faults in --serve")
      ->needs(serve);
  verb->add_option(
          "--udp-json", options->serving.udp_port,
          "With --serve, send 100 ticks a second as JSON to this UDP port of this machine; "
          "the second device sends to the next one. PlotJuggler listens at 9870")
      ->check(CLI::Range(1, 65535))
      ->needs(serve);
  for (const char* const other :
       {"--output", "--hashes", "--explain", "--bodies", "--body-energy", "--fault", "--json"}) {
    serve->excludes(verb->get_option(other));
  }
  verb->footer(kSimExamples);
  verb->callback([options, rate] {
    if (rate->empty()) {
      options->run.rate_hz = described_rate_hz(options->run);
    }
    run_sim(*options);
  });
}

}  // namespace tactus::host
