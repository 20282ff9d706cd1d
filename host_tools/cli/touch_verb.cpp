#include "host_tools/cli/touch_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/explain/explainer.h"
#include "host_tools/explain/steps_csv.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/touch/tool_path.h"
#include "host_tools/touch/touch_csv.h"
#include "rendering/scene/scene_world.h"
#include "rendering/world/world.h"

namespace tactus::host {
namespace {

constexpr const char* kTouchExamples =
    "The path's header is t_s,x_m,y_m,z_m: where the tool's centre is, in the scene's world frame. "
    "The proxy starts at the\n"
    "first position. The tool's velocity, which the damping acts on, is the difference to the row "
    "before (0 in the first).\n"
    "In the output contact is 0 free, 1 face, 2 edge, 3 vertex; friction_state is 0 free, 1 stick, "
    "2 slip; depth_m is how far\n"
    "the proxy stands above the tool along the contact normal; object is the number of the touched "
    "object in the scene;\n"
    "flags are the limits that the tick reached (0: none).\n"
    "In the lecture's words the tool is the HIP (or PHIP), the proxy the god-object (GO).\n"
    "\n"
    "Examples:\n"
    "  tactus touch scene.tactus --path path.csv --output out.csv\n"
    "  tactus plot out.csv --scene scene.tactus\n"
    "  tactus touch scene.tactus --path path.csv --output out.csv --explain steps.csv\n"
    "                                       and every step of every tick: moves, planes, "
    "multipliers, friction circles\n"
    "  tactus touch scene.tactus --path corners.csv --rate 1000 --output out.csv\n"
    "                                       a path of a few corners, a tick every millisecond\n"
    "  tactus touch scene.tactus --path path.csv --output /dev/stdout | cut -d, -f1,8-10\n"
    "  tactus touch scene.tactus --path path.csv --output out.csv --json | jq .max_force_N";

// The verb's options as the user gave them.
struct TouchOptions {
  std::string scene;
  std::string path;
  std::string output;
  std::string explain;
  // Ticks in a second; nothing: one row is one tick.
  std::optional<double> rate_Hz;
  bool json = false;
};

// Counts and extremes over all ticks.
struct TouchSummary {
  std::size_t ticks = 0;
  std::size_t contact_ticks = 0;
  std::size_t flagged_ticks = 0;
  double max_force_N = 0.0;
  double max_depth_m = 0.0;
  double max_short_of_goal_m = 0.0;

  // Adds one tick.
  void add(const rendering::Touch& touch) {
    ++ticks;
    contact_ticks += touch.contact != rendering::ContactKind::none ? 1 : 0;
    flagged_ticks += touch.flags != rendering::kTouchClean ? 1 : 0;
    max_force_N = std::max(max_force_N, touch.force_W.norm());
    max_depth_m = std::max(max_depth_m, touch.depth_m);
    max_short_of_goal_m = std::max(max_short_of_goal_m, touch.short_of_goal_m);
  }
};

// Prints the summary: to standard error if the rows go to standard output.
void print(const TouchOptions& options, const TouchSummary& s) {
  std::FILE* const out = is_standard_output(options.output) ? stderr : stdout;
  if (options.json) {
    const nlohmann::ordered_json json{{"output", options.output},
                                      {"ticks", s.ticks},
                                      {"contact_ticks", s.contact_ticks},
                                      {"flagged_ticks", s.flagged_ticks},
                                      {"max_force_N", s.max_force_N},
                                      {"max_depth_m", s.max_depth_m},
                                      {"max_short_of_goal_m", s.max_short_of_goal_m}};
    fmt::print(out, "{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    return;
  }
  fmt::print(out, "{}: {} ticks, {} in contact, largest force {:.4g} N, largest depth {:.4g} mm\n",
             options.output, s.ticks, s.contact_ticks, s.max_force_N, 1e3 * s.max_depth_m);
  if (s.flagged_ticks > 0) {
    fmt::print(
        out,
        "{} ticks gave something up to a limit (rendering/limits.h); they ended at most {:.4g} "
        "mm short of their goal\n",
        s.flagged_ticks, 1e3 * s.max_short_of_goal_m);
  }
}

void run(const TouchOptions& options) {
  keep_inputs_safe({options.output, options.explain}, {options.scene, options.path});
  const MappedScene scene(options.scene);
  const ToolPath rows(options.path);
  if (const std::optional<std::string> warning = rows.warning()) {
    fmt::print(stderr, "tactus touch: warning: {}\n", *warning);
  }
  const ToolPath path = options.rate_Hz ? rows.sampled(*options.rate_Hz) : rows;
  const auto world = std::make_unique<rendering::World>();
  if (!world->set_scene(scene.image().objects(), rendering::world_of(scene.image()))) {
    throw InputError(fmt::format("{}: the world refuses the scene; bake it again", options.scene));
  }
  TouchCsv file(options.output);
  std::optional<StepsCsv> steps;
  Explainer explainer(scene.image().tool_radius_m());
  if (!options.explain.empty()) {
    steps.emplace(options.explain);
  }
  TouchSummary summary;
  ProgressLine progress;
  constexpr std::size_t kTicksBetweenSteps = 4096;
  for (std::size_t row = 0; row < path.size(); ++row) {
    const rendering::ToolState tool = path.tool(row);
    if (row > 0) {
      world->set_tick(path.step_s(row));
    }
    explainer.begin();
    const rendering::Touch touch = world->touch(tool, steps ? &explainer : nullptr);
    if (steps) {
      steps->add(explainer.finish(row, path.time_s(row), tool.p_W, touch));
    }
    file.add(path.time_s(row), tool.p_W, touch);
    summary.add(touch);
    if (row % kTicksBetweenSteps == 0) {
      progress.step(fmt::format("{} of {} ticks", row, path.size()));
    }
  }
  file.close();
  if (steps) {
    steps->close();
  }
  print(options, summary);
}

}  // namespace

void add_touch_verb(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("touch", "Replay tool positions against a scene, without dynamics");
  const auto options = std::make_shared<TouchOptions>();
  verb->add_option("scene", options->scene, "Scene image (.tactus)")->required();
  verb->add_option("--path", options->path, "Tool positions (CSV)")->required();
  verb->add_option("--rate", options->rate_Hz,
                   "Ticks in a second; the path is straight from row to row. Without it one row is "
                   "one tick")
      ->check(CLI::PositiveNumber);
  verb->add_option("-o,--output", options->output, "Write one row a tick to this CSV file")
      ->required();
  verb->add_option(
      "--explain", options->explain,
      "Write every step of every tick to this CSV file (host_tools/explain/README.md)");
  verb->add_flag("--json", options->json, "Print the summary as one JSON object");
  verb->footer(kTouchExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
