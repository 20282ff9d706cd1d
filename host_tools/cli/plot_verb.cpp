#include "host_tools/cli/plot_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/plot/figures.h"
#include "host_tools/plot/run_data.h"
#include "host_tools/plot/tick_figure.h"
#include "host_tools/plot/tick_steps.h"

namespace tactus::host {
namespace {

constexpr const char* kPlotExamples =
    "Takes the CSV file of `tactus sim` or `tactus touch` and draws two pictures with gnuplot:\n"
    "force and depth over time, and the proxy's path over the scene from two sides.\n"
    "\n"
    "Examples:\n"
    "  tactus plot run.csv --scene scene.tactus              writes run_force.png and run_path.png "
    "here\n"
    "  tactus plot run.csv --scene scene.tactus -o figures/  writes figures/run_force.png, ...\n"
    "  tactus plot run.csv --scene scene.tactus -o ears.svg  writes ears_force.svg and "
    "ears_path.svg for slides; .pdf too\n"
    "  tactus plot shaded.csv --against faceted.csv --scene scene.tactus\n"
    "                                                        and shaded_against.png: both forces, "
    "and how they turn\n"
    "  tactus plot steps.csv --explain --tick 120 --scene scene.tactus\n"
    "                                                        steps_tick120.png: moves, planes and "
    "friction cone of one tick";

// The verb's options as the user gave them.
struct PlotOptions {
  std::string run;
  std::string scene;
  std::string output;
  std::string against;
  bool explain = false;
  TickChoice tick;
};

// Makes the folder of a file if it is missing.
void make_folder_of(const std::filesystem::path& file) {
  std::error_code failure;
  if (file.has_parent_path()) {
    std::filesystem::create_directories(file.parent_path(), failure);
  }
  if (failure) {
    throw InputError(fmt::format("{}: {}", file.parent_path().string(), failure.message()));
  }
}

// Draws one tick of a file that --explain wrote.
void draw_tick(const PlotOptions& options) {
  const TickSteps tick = read_tick_steps(options.run, options.tick);
  const MappedScene scene(options.scene);
  const std::filesystem::path csv(options.run);
  const std::filesystem::path picture =
      figure_file(options.output.empty() ? "./" : options.output, csv.stem().string(),
                  fmt::format("_tick{}", tick.number));
  keep_inputs_safe({picture}, {options.run, options.scene});
  make_folder_of(picture);
  draw_tick_figure(
      tick, scene.image().objects(),
      fmt::format("{}: tick {} at {:.6g} s", csv.filename().string(), tick.number, tick.t_s),
      picture);
  fmt::print("{}\n", picture.string());
}

void run_plot(const PlotOptions& options) {
  const RunData run = read_run(options.run);
  const MappedScene scene(options.scene);
  const std::filesystem::path csv(options.run);
  const FigureFiles files =
      figure_files(options.output.empty() ? "./" : options.output, csv.stem().string());
  keep_inputs_safe({files.force, files.path, files.against},
                   {options.run, options.against, options.scene});
  make_folder_of(files.force);
  const std::string name = csv.filename().string();
  draw_force_figure(run, fmt::format("{}: force and depth", name), files.force);
  draw_path_figure(run, scene.image().objects(), fmt::format("{}: path of the proxy", name),
                   files.path);
  fmt::print("{}\n{}\n", files.force.string(), files.path.string());
  if (!options.against.empty()) {
    const RunData other = read_run(options.against);
    draw_against_figure({run, csv.stem().string()},
                        {other, std::filesystem::path(options.against).stem().string()},
                        files.against);
    fmt::print("{}\n", files.against.string());
  }
}

}  // namespace

void add_plot_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("plot", "Draw figures of a run: force, depth and the path");
  const auto options = std::make_shared<PlotOptions>();
  verb->add_option("run", options->run,
                   "Run (CSV) of tactus sim or tactus touch, or with --explain its steps")
      ->required();
  verb->add_option("--scene", options->scene, "Scene image (.tactus) of the run")->required();
  verb->add_option(
      "-o,--output", options->output,
      "Folder or prefix of the pictures; one that ends in .svg, .pdf or .png gives that format. "
      "Default: PNG files in this folder");
  verb->add_option("--against", options->against,
                   "Another run (CSV), drawn over this one in a third figure");
  CLI::Option* const explain =
      verb->add_flag("--explain", options->explain,
                     "Draw one tick of a file that --explain of touch, sim or replay wrote")
          ->excludes("--against");
  CLI::Option* const tick =
      verb->add_option("--tick", options->tick.number, "For --explain, the number of the tick")
          ->needs(explain);
  CLI::Option* const time =
      verb->add_option("--time", options->tick.t_s, "For --explain, the time of the tick, s")
          ->needs(explain)
          ->excludes(tick);
  verb->add_flag_function(
          "--worst", [](std::int64_t) {},
          "For --explain, the tick with most moves; so it is without --tick")
      ->needs(explain)
      ->excludes(tick)
      ->excludes(time);
  verb->footer(kPlotExamples);
  verb->callback([options] { options->explain ? draw_tick(*options) : run_plot(*options); });
}

}  // namespace tactus::host
