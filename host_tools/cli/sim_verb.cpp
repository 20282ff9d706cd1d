#include "host_tools/cli/sim_verb.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "hal/linux/system.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/cli/serve_simulation.h"
#include "host_tools/explain/run_explanation.h"
#include "host_tools/files/output_place.h"
#include "host_tools/remote/remote.h"
#include "host_tools/simulation/run.h"
#include "host_tools/simulation/run_log.h"
#include "host_tools/simulation/run_recording.h"
#include "rendering/scene/scene_world.h"

namespace tactus::host {
namespace {

constexpr const char* kSimExamples =
    "A wish path is where the hand wants to be, with header t_s,x_m,y_m,z_m; without one the hand\n"
    "presses and strokes the front of the scene for ten seconds (a device with one axis presses\n"
    "on its right side). The device stands so that the middle of the path is the middle of its\n"
    "workspace. The columns of the output and the "
    "devices,\n"
    "hands and faults are described in host_tools/simulation/README.md.\n"
    "\n"
    "Examples:\n"
    "  tactus sim scene.tactus --output run.csv       then: tactus plot run.csv --scene "
    "scene.tactus\n"
    "  tactus sim scene.tactus --device falcon --hand firm --seed 7 --path wish.csv\n"
    "  tactus sim scene.tactus --hashes a.txt && tactus sim scene.tactus --hashes b.txt && cmp "
    "a.txt b.txt\n"
    "  tactus sim scene.tactus --record run.mcap      then: tactus replay run.mcap\n"
    "  tactus sim scene.tactus --explain steps.csv    every move, plane and friction circle of "
    "every tick,\n"
    "                                                 and the times of the loop's seven steps\n"
    "  tactus sim scene.tactus --fault estop@4 --fault stale@2.5x2\n"
    "  tactus sim scene.tactus --seconds 600 --json | jq .simulated_s_per_s\n"
    "  tactus sim scene.tactus --device falcon --serve --run-dir /tmp/tactus\n"
    "    then, elsewhere: export TACTUS_RUN_DIR=/tmp/tactus; tactus home --wait; tactus enable";

// The verb's options as the user gave them.
struct SimOptions {
  std::string scene;
  std::string output;
  std::string hashes;
  std::string record;
  std::string explain;
  bool json = false;
  bool serve = false;
  ServeOptions serving{.run_dir = std::string(kDefaultRunDir)};
  RunOptions run;
};

// The clock of the steps' times, which nothing of the simulation depends on.
std::uint64_t steady_now_ns() {
  return static_cast<std::uint64_t>(hal::monotonic_now_ns());
}

// Writes the outputs that the user asked for and shows the progress, after each tick.
class Recorder {
 public:
  Recorder(const SimOptions& options, double seconds, Simulation& simulation,
           const MappedScene& scene)
      : seconds_(seconds) {
    if (!options.output.empty()) {
      csv_.emplace(options.output);
    }
    if (!options.hashes.empty()) {
      hashes_.emplace(options.hashes);
    }
    if (!options.record.empty()) {
      recording_.emplace(options.record, simulation, scene.bytes());
    }
    if (!options.explain.empty()) {
      explanation_.emplace(options.explain, simulation.controller(), scene.image().tool_radius_m(),
                           steady_now_ns);
    }
    if (::isatty(STDERR_FILENO) == 1) {
      progress_.emplace();
    }
  }

  // Writes the last tick to every output.
  void add(const Simulation& simulation) {
    constexpr std::uint64_t kTicksBetweenSteps = 4096;
    const firmware::TelemetryRecord& record = simulation.record();
    if (csv_) {
      csv_->add(simulation);
    }
    if (hashes_) {
      hashes_->add(record);
    }
    if (recording_) {
      recording_->add(simulation);
    }
    if (explanation_) {
      const firmware::Explanation summary = explanation_->add(record);
      if (recording_) {
        recording_->add(summary);
      }
    }
    if (progress_ && record.tick % kTicksBetweenSteps == 0) {
      progress_->step(fmt::format("{:.1f} of {:.1f} s simulated, mode {}", record.time_s, seconds_,
                                  firmware::mode_name(record.mode)));
    }
  }

  // Completes the outputs. Throws InputError if one cannot be written to its end.
  void close() {
    progress_.reset();
    if (csv_) {
      csv_->close();
    }
    if (hashes_) {
      hashes_->close();
    }
    if (recording_) {
      recording_->close();
    }
    if (explanation_) {
      explanation_->close();
    }
  }

 private:
  double seconds_;
  std::optional<RunCsv> csv_;
  std::optional<HashLog> hashes_;
  std::optional<RunRecording> recording_;
  std::optional<RunExplanation> explanation_;
  std::optional<ProgressLine> progress_;
};

void run_sim(const SimOptions& options) {
  keep_inputs_safe({options.output, options.hashes, options.record, options.explain},
                   {options.scene, options.run.path});
  if (options.serve) {
    ServeOptions serving = options.serving;
    serving.record = options.record;
    serve_simulation(options.scene, options.run, serving);
    return;
  }
  const MappedScene scene(options.scene);
  const auto objects = scene.image().objects();
  const double tool_radius_m = scene.image().tool_radius_m();
  RunPlan plan = plan_run(options.run, objects, tool_radius_m);
  plan.config.world = rendering::world_of(scene.image());
  for (const std::string& warning : plan.warnings) {
    fmt::print(stderr, "tactus sim: warning: {}\n", warning);
  }
  Simulation simulation(plan.config, objects, tool_radius_m);
  Recorder recorder(options, plan.seconds, simulation, scene);
  const RunSummary summary = run(simulation, plan.seconds, options.run.rate_hz,
                                 [&](const Simulation& now) { recorder.add(now); });
  recorder.close();
  // Rows on standard output must not be mixed with the summary.
  std::FILE* const out =
      is_standard_output(options.output) || is_standard_output(options.hashes) ? stderr : stdout;
  fmt::print(out, "{}", options.json ? summary_json(summary) : summary_text(summary));
}

}  // namespace

void add_sim_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "sim", "Let a simulated hand and device touch a scene through the controller");
  const auto options = std::make_shared<SimOptions>();
  RunOptions& run = options->run;
  verb->add_option("scene", options->scene, "Scene image (.tactus)")->required();
  verb->add_option("--device", run.device,
                   fmt::format("{}", fmt::join(firmware::kPresetNames, ", ")))
      ->capture_default_str();
  verb->add_option("--hand", run.hand, "finger, pen or firm")->capture_default_str();
  verb->add_option("--seed", run.seed, "Seed of the hand's tremor")->capture_default_str();
  verb->add_option("--seconds", run.seconds,
                   "How long to simulate; default: until the wish path ends");
  verb->add_option("--rate-hz", run.rate_hz, "Ticks of the controller a second, 50 to 50000")
      ->capture_default_str();
  verb->add_option("--compensate", run.compensated_share,
                   "Share of the joints' friction that the controller takes over, 0 to 0.9")
      ->capture_default_str();
  verb->add_option("--path", run.path, "Wish path of the hand (CSV)");
  verb->add_option("-o,--output", options->output, "Write one line a tick to this CSV file");
  verb->add_option("--hashes", options->hashes, "Write the state hash of every tick to this file");
  verb->add_option("--record", options->record,
                   "Record the run to this MCAP file, for tactus replay");
  verb->add_option(
      "--explain", options->explain,
      "Write every step of every tick to this CSV file (host_tools/explain/README.md)");
  verb->add_option("--fault", run.faults,
                   "Let the device fail: stale, nan, estop or lost, like stale@2.5x3");
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
  for (const char* const other : {"--output", "--hashes", "--explain", "--fault", "--json"}) {
    serve->excludes(verb->get_option(other));
  }
  verb->footer(kSimExamples);
  verb->callback([options] { run_sim(*options); });
}

}  // namespace tactus::host
