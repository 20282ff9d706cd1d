#include "host_tools/cli/demo_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/cli/bake_report.h"
#include "host_tools/cli/plot_run.h"
#include "host_tools/cli/simulate.h"
#include "host_tools/examples/heart/scene.toml.h"
#include "host_tools/examples/heart/wish.csv.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/plot/run_data.h"

namespace tactus::host {
namespace {

constexpr const char* kDemoExamples =
    "Bakes FOLDER/scene.toml, lets a simulated hand follow FOLDER/wish.csv through the real\n"
    "controller, and draws the run. Everything is written into FOLDER. A new folder begins with\n"
    "the heart of the examples, which is stroked for ten seconds. Without wish.csv the hand\n"
    "strokes the front of the scene, as in `tactus sim`.\n"
    "\n"
    "Examples:\n"
    "  tactus demo                    a hand draws a heart on a heart; then look at\n"
    "                                 tactus-demo/run_path.png\n"
    "  tactus demo                    again, after you have changed tactus-demo/scene.toml\n"
    "  cp -r /usr/share/tactus/examples/friction . && tactus demo friction\n"
    "                                 another example, or a scene of your own";

// The files of a demo. Inputs come first, then what it writes.
struct DemoFiles {
  std::filesystem::path scene;
  std::filesystem::path wish;
  std::filesystem::path image;
  std::filesystem::path run;
  FigureFiles figures;
};

DemoFiles demo_files(const std::filesystem::path& folder) {
  return {.scene = folder / "scene.toml",
          .wish = folder / "wish.csv",
          .image = folder / "scene.tactus",
          .run = folder / "run.csv",
          .figures = figure_files(folder / "", "run")};
}

void write_text(const std::filesystem::path& file, std::string_view text) {
  write_file_atomically(file, std::as_bytes(std::span(text)));
}

// Writes the example into a folder that is new or empty. A folder with a scene stays as it is; in
// any other one the user did not mean to have a demo.
void begin_demo(const std::filesystem::path& folder, const DemoFiles& files) {
  if (std::filesystem::exists(files.scene)) {
    return;
  }
  if (std::filesystem::exists(folder) &&
      !(std::filesystem::is_directory(folder) && std::filesystem::is_empty(folder))) {
    throw InputError(fmt::format(
        "{}: has no scene.toml; name a folder that has one, or a new one for the example",
        folder.string()));
  }
  make_folder_of(files.scene);
  write_text(files.wish, kHeartWish);
  write_text(files.scene, kHeartScene);
}

void demo_step(std::string_view text) {
  fmt::print("\n==> {}\n", text);
  std::fflush(stdout);
}

void run_demo(const std::filesystem::path& folder) {
  const DemoFiles files = demo_files(folder);
  begin_demo(folder, files);

  demo_step(
      fmt::format("1/3 Bake {}: text and meshes become one checked image", files.scene.string()));
  const BakeReport report = bake_with_progress(files.scene, files.image);
  print_bake_warnings("demo", report);
  print_bake_table(report);

  demo_step("2/3 Touch it: a simulated hand and device, and the real controller, in lockstep");
  RunOptions options;
  if (std::filesystem::exists(files.wish)) {
    options.paths = {files.wish.string()};
  }
  for (const RunSummary& summary :
       simulate("demo", files.image, options, {.output = files.run.string()})) {
    fmt::print("{}", summary_text(summary));
  }

  demo_step("3/3 Draw it");
  const MappedScene scene(files.image);
  const RunData run = read_run(files.run);
  plot_run({run, files.run.filename().string()}, scene.image().objects(), files.figures);

  demo_step("Done. Look at");
  fmt::print(
      "  {}   the path over the scene, from two sides; the colour is the force\n"
      "  {}  force and depth over time\n"
      "  {}        every tick: tool, proxy, force, contact, friction\n"
      "Then change {} and run it again: a stiffness, a friction, another shape.\n",
      files.figures.path.string(), files.figures.force.string(), files.run.string(),
      files.scene.string());
}

}  // namespace

void add_demo_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "demo", "Bake a scene, simulate ten seconds of touch and draw them: everything once");
  const auto folder = std::make_shared<std::string>("tactus-demo");
  verb->add_option("folder", *folder, "Folder of the demo; a new one gets an example")
      ->capture_default_str();
  verb->footer(kDemoExamples);
  verb->callback([folder] { run_demo(*folder); });
}

}  // namespace tactus::host
