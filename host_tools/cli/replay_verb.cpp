#include "host_tools/cli/replay_verb.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host_tools/cli/picture_option.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/cli/replay_explanation.h"
#include "host_tools/cli/replay_report.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/plot/figures.h"
#include "host_tools/replay/replay.h"
#include "host_tools/replay/what_if.h"
#include "host_tools/simulation/run_log.h"

namespace tactus::host {
namespace {

// The exit code if a tick differs.
constexpr int kDiffers = 1;

constexpr const char* kReplayExamples =
    "Gives the controller the recorded inputs once more and compares the hash of every tick, "
    "which\n"
    "is a chain over all that was felt and commanded. Stops at the first that differs and names "
    "the\n"
    "field. Configuration and scene come out of the recording; an image that is given instead "
    "must\n"
    "be the one that it was made with.\n"
    "\n"
    "--set then shows what would have been felt with another parameter: the same motion of the "
    "hand,\n"
    "the force that the controller would have given. The names are those of tactus get.\n"
    "\n"
    "Ends with 0 if every tick is equal, 1 if one differs, 2 if it could not be replayed.\n"
    "\n"
    "Examples:\n"
    "  tactus sim scene.tactus --record run.mcap && tactus replay run.mcap\n"
    "  tactus replay flight-20261122T101500Z-81920.mcap     the last seconds before a fault\n"
    "  tactus replay run.mcap --device falcon.tactus --scene scene.tactus\n"
    "  tactus replay run.mcap run.2.mcap                    a run of two devices\n"
    "  tactus replay run.mcap --set max_force_N=4 --csv forces.csv\n"
    "  tactus replay run.mcap --explain steps.csv           every move, plane and friction circle\n"
    "  tactus replay run.mcap --set object.wall.stiffness_N_per_m=300 --picture forces.png\n"
    "  tactus replay run.mcap --set object.wall.contact=one_plane    by another contact method\n"
    "  tactus replay run.mcap --set object.wall.friction_model=dahl";

// The verb's options as the user gave them.
struct ReplayOptions {
  // One for each device of the run.
  std::vector<std::string> recordings;
  RunImages images;
  std::vector<std::string> changes;
  std::string csv;
  std::string picture;
  std::string explain;
  bool json = false;
};

// Returns true if every replayed tick equals the recorded one.
bool compare(std::deque<RecordedRun>& runs, const ReplayOptions& options) {
  std::vector<RecordedRun*> devices;
  devices.reserve(runs.size());
  for (RecordedRun& each : runs) {
    devices.push_back(&each);
  }
  RecordedRun& run = runs.front();
  const double rate_hz = run.setup().config.rate_hz;
  std::optional<ProgressLine> progress;
  if (::isatty(STDERR_FILENO) == 1) {
    progress.emplace();
  }
  std::optional<ReplayExplanation> explanation;
  const auto begin = [&](firmware::Controller& controller) {
    if (!options.explain.empty()) {
      explanation.emplace(options.explain, controller, run.setup().world.tool_radius_m,
                          run.ticks());
    }
  };
  const auto see = [&](const firmware::RecordedTick& tick) {
    constexpr std::uint64_t kTicksBetweenSteps = 4096;
    if (explanation) {
      explanation->add(tick.record);
    }
    if (progress && tick.record.tick % kTicksBetweenSteps == 0) {
      progress->step(fmt::format("tick {}, {:.1f} s: equal", tick.record.tick, tick.record.time_s));
    }
  };
  const ReplayResult result = replay(devices, see, begin);
  progress.reset();
  if (explanation) {
    explanation->close();
  }
  if (result.ticks == 0 && !result.difference) {
    throw InputError(run.name() + ": it holds no tick to replay");
  }
  print_replay({.result = result, .rate_hz = rate_hz, .devices = devices.size()}, options.json);
  return !result.difference.has_value() && (!explanation || explanation->agrees());
}

// Returns a row that has a force only.
RunRow row_of(double time_s, const Vec3& force_W) {
  return {.t_s = time_s, .force_W = force_W, .force_N = force_W.norm()};
}

// Returns as many rows as a picture can show.
RunData thinned(const std::vector<RunRow>& rows) {
  constexpr std::size_t kMostRows = 8000;
  RunData data;
  for (const std::size_t i : thin(rows, kMostRows)) {
    data.rows.push_back(rows[i]);
  }
  return data;
}

// Collects both forces of every tick and writes them to the outputs that the user named.
class ForceTraces {
 public:
  explicit ForceTraces(const ReplayOptions& options) : picture_(options.picture) {
    if (!options.csv.empty()) {
      csv_.emplace(options.csv,
                   "t_s,recorded_x_N,recorded_y_N,recorded_z_N,changed_x_N,changed_y_N,"
                   "changed_z_N\n");
    }
  }

  // Takes a tick into the outputs.
  void add(const WhatIfTick& tick) {
    if (csv_) {
      const Vec3& a = tick.recorded_W;
      const Vec3& b = tick.changed_W;
      csv_->buffer() += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                                    tick.time_s, a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
      csv_->flush_if_full();
    }
    if (!picture_.empty()) {
      recorded_.push_back(row_of(tick.time_s, tick.recorded_W));
      changed_.push_back(row_of(tick.time_s, tick.changed_W));
    }
  }

  // Completes the CSV file and draws the picture.
  void close() {
    if (csv_) {
      csv_->close();
    }
    if (!changed_.empty()) {
      draw_against_figure({thinned(changed_), "as changed"}, {thinned(recorded_), "as recorded"},
                          picture_);
    }
  }

 private:
  std::string picture_;
  std::optional<LogFile> csv_;
  std::vector<RunRow> recorded_;
  std::vector<RunRow> changed_;
};

// Replays with the user's changes and prints both forces side by side.
void show_changed(RecordedRun& run, const ReplayOptions& options) {
  std::vector<firmware::ParameterChange> changes;
  changes.reserve(options.changes.size());
  for (const std::string& text : options.changes) {
    changes.push_back(parse_change(text, run.scene()));
  }
  ForceTraces traces(options);
  const WhatIfSummary summary =
      what_if(run, changes, [&](const WhatIfTick& tick) { traces.add(tick); });
  traces.close();
  print_change(summary, options.json);
}

// Returns the exit code. Throws InputError if the recording cannot be replayed.
int run_replay(const ReplayOptions& options) {
  if (options.changes.empty() && (!options.csv.empty() || !options.picture.empty())) {
    throw InputError(
        "--csv and --picture show two forces: give --set name=value, too. tactus export writes a "
        "recording as CSV");
  }
  const bool is_alone = options.recordings.size() == 1;
  if (!is_alone && (!options.changes.empty() || !options.images.device.empty())) {
    throw InputError("--set and --device take the recording of a run with one device");
  }
  std::vector<std::filesystem::path> inputs(options.recordings.begin(), options.recordings.end());
  inputs.emplace_back(options.images.device);
  inputs.emplace_back(options.images.scene);
  keep_inputs_safe(
      std::vector<std::filesystem::path>{options.csv, options.picture, options.explain}, inputs);
  std::deque<RecordedRun> runs;
  for (const std::string& recording : options.recordings) {
    runs.emplace_back(recording, options.images);
  }
  if (!compare(runs, options)) {
    return kDiffers;
  }
  if (!options.changes.empty()) {
    show_changed(runs.front(), options);
  }
  return 0;
}

}  // namespace

void add_replay_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("replay", "Live a recorded run once more, and compare");
  const auto options = std::make_shared<ReplayOptions>();
  verb->add_option("recording", options->recordings,
                   "Recording (.mcap); of a run with several devices that of each, in their order")
      ->required();
  verb->add_option("--device", options->images.device, "Device image (.tactus) of the run");
  verb->add_option("--scene", options->images.scene, "Scene image (.tactus) of the run");
  verb->add_option("--set", options->changes, "A parameter as it was not, like max_force_N=4");
  verb->add_option("--csv", options->csv, "With --set: write both forces of every tick there");
  verb->add_option("--picture", options->picture,
                   "With --set: draw both forces there (.png, .svg or .pdf)")
      ->check(picture_complaint);
  verb->add_option("--explain", options->explain,
                   "Write every step of every tick of the first device to this CSV file "
                   "(host_tools/explain/README.md)");
  verb->add_flag("--json", options->json,
                 "Print what was found as one JSON object, with --set a second one of both forces");
  verb->footer(kReplayExamples);
  verb->callback([options] {
    if (const int code = run_replay(*options); code != 0) {
      throw CLI::RuntimeError(code);
    }
  });
}

}  // namespace tactus::host
