#include "host_tools/cli/plot_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "host_tools/cli/plot_bodies.h"
#include "host_tools/cli/plot_run.h"
#include "host_tools/cli/plot_scene.h"
#include "host_tools/cli/plot_steps.h"
#include "host_tools/cli/plot_transitions.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/plot/figures.h"
#include "host_tools/plot/gnuplot.h"
#include "host_tools/plot/run_data.h"

namespace tactus::host {
namespace {

constexpr const char* kPlotExamples =
    "Takes a recording (.mcap), or a table (.csv) of `tactus sim`, `tactus touch`, tactusd or "
    "`tactus export`, and draws\n"
    "two pictures with gnuplot: force and depth over time, and the proxy's path over the scene "
    "from two sides.\n"
    "\n"
    "Examples:\n"
    "  tactus plot run.mcap                                  run_force.png and run_path.png, with "
    "the scene that is inside\n"
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
    "friction cone of one tick,\n"
    "                                                        or iterations over the field of a "
    "formula\n"
    "  tactus plot steps.csv --explain --ticks 860..880/5 --scene scene.tactus -o strip.svg\n"
    "                                                        five ticks in a row with common axes\n"
    "  tactus plot steps.csv --explain --ticks 800..900/2 --scene scene.tactus --animation "
    "stroke.apng\n"
    "                                                        a stroke, ten times slower than it "
    "was\n"
    "  tactus plot steps.csv --explain --ticks 800..900/2 --scene scene.tactus --frames frames/ "
    "--format svg\n"
    "                                                        frames/frame_0001.svg, ... for "
    "slides\n"
    "  tactus plot run.csv --bodies bodies.csv --frames 6 --scene scene.tactus\n"
    "                                                        bodies_frames.png: six times of the "
    "run, bodies and tools\n"
    "  tactus plot steps.csv --transitions --scene scene.tactus\n"
    "                                                        steps_transitions.png: changes "
    "between free, face, edge, vertex";

// The verb's options as the user gave them.
struct PlotOptions {
  std::string run;
  std::string scene;
  std::string output;
  std::string against;
  std::string bodies;
  std::string format = "png";
  std::shared_ptr<StepsPlotOptions> steps = std::make_shared<StepsPlotOptions>();
  bool transitions = false;
};

// Returns the format of that name.
PictureFormat format_named(const std::string& name) {
  return picture_format("picture." + name);
}

// Reads a run, and says if its end is missing.
RunData whole_run(const std::string& file) {
  RunData run = read_run(file);
  if (run.is_cut) {
    fmt::print(stderr, "tactus plot: warning: {} was cut off: its last ticks are missing\n", file);
  }
  return run;
}

void run_plot(const PlotOptions& options) {
  const PlotScene scene(options.scene, options.run);
  const RunData run = whole_run(options.run);
  const std::filesystem::path file(options.run);
  const FigureFiles files = figure_files(options.output.empty() ? "./" : options.output,
                                         file.stem().string(), format_named(options.format));
  keep_inputs_safe({files.force, files.path, files.against},
                   {options.run, options.against, options.scene});
  make_folder_of(files.force);
  plot_run({run, file.filename().string()}, scene.image().objects(), files);
  if (!options.against.empty()) {
    const RunData other = whole_run(options.against);
    draw_against_figure({run, file.stem().string()},
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
                   "Recording (.mcap) or table (.csv) of a run, or with --explain its steps")
      ->required();
  verb->add_option(
      "--scene", options->scene,
      "Scene image (.tactus) of the run; --transitions can do without, and a recording "
      "has its own inside");
  verb->add_option(
      "-o,--output", options->output,
      "Folder or prefix of the pictures; one that ends in .svg, .pdf or .png gives that format. "
      "Default: PNG files in this folder");
  verb->add_option("--bodies", options->bodies,
                   "For --frames, the bodies (CSV) of the run; without it the run itself");
  CLI::Option* const against = verb->add_option(
      "--against", options->against, "Another run, drawn over this one in a third figure");
  verb->add_option("--format", options->format, "Format of the pictures in a folder")
      ->check(CLI::IsMember({"png", "svg", "pdf"}))
      ->capture_default_str();
  add_steps_options(*verb, options->steps);
  verb->get_option("--explain")->excludes(against);
  verb->add_flag("--transitions", options->transitions,
                 "Count and draw the changes of state: free, face, edge, vertex")
      ->excludes("--explain")
      ->excludes(against);
  verb->footer(kPlotExamples);
  verb->callback([options] {
    if (is_recording(options->run) && (options->transitions || options->steps->is_wanted)) {
      throw InputError(fmt::format(
          "{0}: a recording has no steps; let them be written: tactus replay {0} --explain "
          "steps.csv",
          options->run));
    }
    if (options->transitions) {
      plot_transitions(options->run, options->scene, options->output,
                       format_named(options->format));
      return;
    }
    if (options->scene.empty() && !is_recording(options->run)) {
      throw CLI::RequiredError("--scene");
    }
    if (!options->steps->is_wanted && !options->steps->frames.empty()) {
      plot_bodies({.run = options->run,
                   .bodies = options->bodies,
                   .scene = options->scene,
                   .output = options->output.empty() ? "./" : options->output,
                   .format = format_named(options->format),
                   .frames = options->steps->frames});
    } else if (options->steps->is_wanted) {
      draw_steps(*options->steps, {.steps = options->run,
                                   .scene = options->scene,
                                   .output = options->output.empty() ? "./" : options->output,
                                   .format = format_named(options->format)});
    } else {
      run_plot(*options);
    }
  });
}

}  // namespace tactus::host
