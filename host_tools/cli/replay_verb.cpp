#include "host_tools/cli/replay_verb.h"

#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <string>

#include "host_tools/cli/progress_line.h"
#include "host_tools/replay/replay.h"

namespace tactus::host {
namespace {

constexpr int kDiffers = 1;

constexpr const char* kExamples =
    "Gives the controller the recorded inputs once more and compares the hash of every tick, "
    "which\n"
    "is a chain over all that was felt and commanded. Stops at the first that differs and names "
    "the\n"
    "field. Configuration and scene come out of the recording; an image that is given instead "
    "must\n"
    "be the one that it was made with.\n"
    "\n"
    "Ends with 0 if every tick is equal, 1 if one differs, 2 if it could not be replayed.\n"
    "\n"
    "Examples:\n"
    "  tactus sim scene.tactus --record run.mcap && tactus replay run.mcap\n"
    "  tactus replay flight.mcap                  the last seconds before a fault, as tactusd "
    "wrote "
    "them\n"
    "  tactus replay run.mcap --device falcon.tactus --scene scene.tactus";

struct Options {
  std::string recording;
  RunImages images;
};

int run_replay(const Options& options) {
  RecordedRun run(options.recording, options.images);
  const double rate_hz = run.setup().config.rate_hz;
  std::optional<ProgressLine> progress;
  if (::isatty(STDERR_FILENO) == 1) {
    progress.emplace();
  }
  const ReplayResult result = replay(run, [&](const firmware::RecordedTick& tick) {
    constexpr std::uint64_t kTicksBetweenSteps = 4096;
    if (progress && tick.record.tick % kTicksBetweenSteps == 0) {
      progress->step(fmt::format("tick {}, {:.1f} s: equal", tick.record.tick, tick.record.time_s));
    }
  });
  progress.reset();
  if (result.ticks > 0) {
    fmt::print("ticks {} to {} ({:.3f} s): every hash equal\n", result.first_tick,
               result.first_tick + result.ticks - 1, static_cast<double>(result.ticks) / rate_hz);
  } else if (!result.difference) {
    throw InputError(options.recording + ": it holds no tick to replay");
  }
  if (result.cut) {
    fmt::print("the recording was cut off: its last ticks are missing\n");
  }
  if (const auto& difference = result.difference) {
    fmt::print("tick {} ({:.3f} s) differs: {} was {} and is now {}\n", difference->tick,
               static_cast<double>(difference->tick) / rate_hz, difference->field,
               difference->recorded, difference->replayed);
  }
  return result.difference ? kDiffers : 0;
}

}  // namespace

void add_replay_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("replay", "Live a recorded run once more, and compare");
  const auto options = std::make_shared<Options>();
  verb->add_option("recording", options->recording, "Recording (.mcap)")->required();
  verb->add_option("--device", options->images.device, "Device image (.tactus) of the run");
  verb->add_option("--scene", options->images.scene, "Scene image (.tactus) of the run");
  verb->footer(kExamples);
  verb->callback([options] {
    if (const int code = run_replay(*options); code != 0) {
      throw CLI::RuntimeError(code);
    }
  });
}

}  // namespace tactus::host
