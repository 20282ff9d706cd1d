#include "host_tools/cli/plot_steps.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <system_error>
#include <vector>

#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/plot/apng.h"
#include "host_tools/plot/figures.h"
#include "host_tools/plot/tick_figure.h"

namespace tactus::host {
namespace {

namespace fs = std::filesystem;

// More frames are a film, and hours of work.
constexpr std::size_t kMostFrames = 2000;
// Without a rate a stroke plays so many times slower than it was.
constexpr double kSlowness = 10.0;

void draw_tick(const StepsPlotOptions& options, const StepsPlotFiles& files) {
  const TickSteps tick = read_tick_steps(files.steps, options.tick);
  const MappedScene scene(files.scene);
  const fs::path csv(files.steps);
  const fs::path picture = figure_file(files.output, csv.stem().string(),
                                       fmt::format("_tick{}", tick.number), files.format);
  keep_inputs_safe({picture}, {files.steps, files.scene});
  make_folder_of(picture);
  draw_tick_figure(
      tick, scene.image().objects(),
      fmt::format("{}: tick {} at {:.6g} s", csv.filename().string(), tick.number, tick.t_s),
      picture);
  fmt::print("{}\n", picture.string());
}

void draw_strip(const TickRange& range, const StepsPlotFiles& files) {
  if (range.count() > kMostStripTicks) {
    throw InputError(fmt::format(
        "{} ticks are too many for a strip, which has at most {}; take a larger step, such as "
        "{}..{}/{}, or draw --frames or an --animation",
        range.count(), kMostStripTicks, range.first, range.last,
        (range.last - range.first + kMostStripTicks - 2) / (kMostStripTicks - 1)));
  }
  const std::vector<TickSteps> ticks = read_ticks(files.steps, range);
  const MappedScene scene(files.scene);
  const fs::path csv(files.steps);
  const fs::path picture = figure_file(
      files.output, csv.stem().string(),
      fmt::format("_ticks{}-{}", ticks.front().number, ticks.back().number), files.format);
  keep_inputs_safe({picture}, {files.steps, files.scene});
  make_folder_of(picture);
  draw_tick_strip(ticks, scene.image().objects(),
                  fmt::format("{}: ticks {} to {}", csv.filename().string(), ticks.front().number,
                              ticks.back().number),
                  picture);
  fmt::print("{}\n", picture.string());
}

// Makes the folder of the frames. Throws InputError if it has files already: frames of an earlier
// stroke would be among the new ones.
void make_frames_folder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure || !fs::is_directory(folder)) {
    throw InputError(fmt::format("{}: cannot make the folder: {}", folder.string(),
                                 failure ? failure.message() : "it is a file"));
  }
  if (!fs::is_empty(folder)) {
    throw InputError(
        fmt::format("{}: the folder is not empty; name a new one for the frames", folder.string()));
  }
}

// Returns the time for which a frame is shown.
double frame_time_s(const StepsPlotOptions& options, std::span<const TickSteps> ticks) {
  if (options.frames_per_s) {
    return 1.0 / *options.frames_per_s;
  }
  const double real_s = ticks.size() < 2 ? 0.0
                                         : (ticks.back().t_s - ticks.front().t_s) /
                                               static_cast<double>(ticks.size() - 1);
  return std::clamp(kSlowness * real_s, kLeastFrame_s, kMostFrame_s);
}

void check_animation(const StepsPlotOptions& options) {
  const std::string extension = fs::path(options.animation).extension().string();
  if (!options.animation.empty() && extension != ".apng" && extension != ".png") {
    throw InputError(
        fmt::format("{}: an animation's name ends in .apng or .png", options.animation));
  }
}

// Draws the frames into their folder, for an animation into one of its own.
void draw_frames(const StepsPlotOptions& options, const StepsPlotFiles& files,
                 const TickRange& range) {
  if (range.count() > kMostFrames) {
    throw InputError(fmt::format("{} frames are too many; at most {} are drawn: take a larger step",
                                 range.count(), kMostFrames));
  }
  check_animation(options);
  keep_inputs_safe({options.animation}, {files.steps, files.scene});
  const std::vector<TickSteps> ticks = read_ticks(files.steps, range);
  const MappedScene scene(files.scene);
  const TickFrames frames(ticks, scene.image().objects(), fs::path(files.steps).stem().string());
  if (!options.frames.empty()) {
    make_frames_folder(options.frames);
  }
  const GnuplotFolder own;
  std::vector<std::string> pictures;
  {
    ProgressLine progress;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      progress.step(fmt::format("frame {} of {}", i + 1, ticks.size()),
                    static_cast<double>(i) / static_cast<double>(ticks.size()));
      const auto draw = [&](const fs::path& folder, PictureFormat format) {
        const fs::path file = folder / fmt::format("frame_{:04}{}", i + 1, extension_of(format));
        frames.draw(i, file);
        return file;
      };
      if (!options.frames.empty()) {
        draw(options.frames, files.format);
      }
      if (!options.animation.empty()) {
        pictures.push_back(read_file(draw(own.path(), PictureFormat::png)));
      }
    }
  }
  if (!options.frames.empty()) {
    fmt::print("{}: {} frames\n", options.frames, ticks.size());
  }
  if (!options.animation.empty()) {
    const double frame_s = frame_time_s(options, ticks);
    const std::string file = apng_of(pictures, frame_s);
    make_folder_of(options.animation);
    write_file_atomically(options.animation, std::as_bytes(std::span(file)));
    fmt::print("{}: {} frames, {:.4g} a second\n", options.animation, ticks.size(), 1.0 / frame_s);
  }
}

}  // namespace

void add_steps_options(CLI::App& verb, const std::shared_ptr<StepsPlotOptions>& options) {
  CLI::Option* const explain =
      verb.add_flag("--explain", options->is_wanted,
                    "Draw ticks of a file that --explain of touch, sim or replay wrote");
  CLI::Option* const tick =
      verb.add_option("--tick", options->tick.number, "For --explain, the number of the tick")
          ->needs(explain);
  CLI::Option* const time =
      verb.add_option("--time", options->tick.t_s, "For --explain, the time of the tick, s")
          ->needs(explain)
          ->excludes(tick);
  CLI::Option* const worst =
      verb.add_flag_function(
              "--worst", [](std::int64_t) {},
              "For --explain, the tick with most moves; so it is without --tick")
          ->needs(explain)
          ->excludes(tick)
          ->excludes(time);
  CLI::Option* const ticks =
      verb.add_option_function<std::string>(
              "--ticks",
              [options](const std::string& text) { options->range = parse_tick_range(text); },
              "For --explain, every STEPth tick: FIRST..LAST/STEP. They are drawn in one strip, "
              "with common axes")
          ->needs(explain)
          ->excludes(tick)
          ->excludes(time)
          ->excludes(worst);
  verb.add_option("--frames", options->frames,
                  "For --ticks, draw each tick as a numbered picture into this new folder instead; "
                  "without --explain, draw the moving bodies in a strip of so many pictures");
  CLI::Option* const animation =
      verb.add_option("--animation", options->animation,
                      "For --ticks, draw them as an animation into this .apng file instead")
          ->needs(ticks);
  verb.add_option("--frames-per-second", options->frames_per_s,
                  "Rate of the animation; default: ten times slower than the stroke was")
      ->needs(animation)
      ->check(CLI::Range(1.0 / kMostFrame_s, 1.0 / kLeastFrame_s));
}

void draw_steps(const StepsPlotOptions& options, const StepsPlotFiles& files) {
  if (!options.range && !options.frames.empty()) {
    throw InputError("--frames: with --explain it needs --ticks FIRST..LAST");
  }
  if (!options.range) {
    draw_tick(options, files);
  } else if (!options.frames.empty() || !options.animation.empty()) {
    draw_frames(options, files, *options.range);
  } else {
    draw_strip(*options.range, files);
  }
}

}  // namespace tactus::host
