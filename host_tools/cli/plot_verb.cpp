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

namespace tactus::host {
namespace {

constexpr const char* kPlotExamples =
    "Takes the CSV file of `tactus sim` or `tactus touch` and draws two PNG files with gnuplot:\n"
    "force and depth over time, and the proxy's path over the scene from two sides.\n"
    "\n"
    "Examples:\n"
    "  tactus plot run.csv --scene scene.tactus              writes run_force.png and run_path.png "
    "here\n"
    "  tactus plot run.csv --scene scene.tactus -o figures/  writes figures/run_force.png, ...\n"
    "  tactus plot run.csv --scene scene.tactus -o ears      writes ears_force.png and "
    "ears_path.png\n"
    "  tactus plot shaded.csv --against faceted.csv --scene scene.tactus\n"
    "                                                        and shaded_against.png: both forces, "
    "and how they turn";

// The verb's options as the user gave them.
struct PlotOptions {
  std::string run;
  std::string scene;
  std::string output;
  std::string against;
};

void run_plot(const PlotOptions& options) {
  const RunData run = read_run(options.run);
  const MappedScene scene(options.scene);
  const std::filesystem::path csv(options.run);
  const FigureFiles files =
      figure_files(options.output.empty() ? "./" : options.output, csv.stem().string());
  keep_inputs_safe({files.force, files.path, files.against},
                   {options.run, options.against, options.scene});
  std::error_code failure;
  if (files.force.has_parent_path()) {
    std::filesystem::create_directories(files.force.parent_path(), failure);
  }
  if (failure) {
    throw InputError(fmt::format("{}: {}", files.force.parent_path().string(), failure.message()));
  }
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
  verb->add_option("run", options->run, "Run (CSV) of tactus sim or tactus touch")->required();
  verb->add_option("--scene", options->scene, "Scene image (.tactus) of the run")->required();
  verb->add_option("-o,--output", options->output,
                   "Folder or prefix of the PNG files; default: this folder");
  verb->add_option("--against", options->against,
                   "Another run (CSV), drawn over this one in a third figure");
  verb->footer(kPlotExamples);
  verb->callback([options] { run_plot(*options); });
}

}  // namespace tactus::host
