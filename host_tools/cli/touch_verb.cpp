#include "host_tools/cli/touch_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/touch/body_files.h"
#include "host_tools/touch/follow_paths.h"
#include "host_tools/touch/tool_path.h"
#include "host_tools/touch/tool_paths.h"
#include "host_tools/touch/tool_record.h"
#include "host_tools/touch/touch_summary.h"

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
    "Each --path is a tool of its own, with the scene's radius; they touch one world, and feel "
    "each other through bodies alone. The first\n"
    "tool's rows go to run.csv if --output says so, those of the others to run.2.csv, run.3.csv "
    "and so on. A row of all paths is\n"
    "one tick, so it has the same time in each of them, unless --rate samples them. The run lasts "
    "as long as the longest\n"
    "path; a path that ends leaves its tool where it is.\n"
    "\n"
    "Examples:\n"
    "  tactus touch scene.tactus --path path.csv --output out.csv\n"
    "  tactus plot out.csv --scene scene.tactus\n"
    "  tactus touch scene.tactus --path path.csv --output out.csv --explain steps.csv\n"
    "                                       and every step of every tick: moves, planes, "
    "multipliers, friction circles\n"
    "  tactus touch scene.tactus --path path.csv --output out.csv --hashes out.txt\n"
    "                                       and one number a tick, by which two runs are the same "
    "to the bit\n"
    "  tactus touch scene.tactus --path corners.csv --rate 1000 --output out.csv\n"
    "                                       a path of a few corners, a tick every millisecond\n"
    "  tactus touch scene.tactus --path thumb.csv --path finger.csv --output run.csv --explain "
    "steps.csv\n"
    "  tactus plot run.2.csv --scene scene.tactus\n"
    "                                       two tools: run.csv and steps.csv are the thumb's, "
    "run.2.csv and steps.2.csv the\n"
    "                                       finger's\n"
    "  tactus touch grasp.tactus --path thumb.csv --path finger.csv --output run.csv --bodies "
    "bodies.csv\n"
    "                                       and where each body is: its centre of mass, rotation "
    "and velocities\n"
    "  tactus touch scene.tactus --path path.csv --output /dev/stdout | cut -d, -f1,8-10\n"
    "  tactus touch scene.tactus --path path.csv --output out.csv --json | jq .max_force_N";

// The verb's options as the user gave them.
struct TouchOptions {
  std::string scene;
  // One for each tool.
  std::vector<std::string> paths;
  std::string output;
  std::string explain;
  std::string hashes;
  BodyFileNames bodies;
  // Ticks in a second; nothing: one row is one tick.
  std::optional<double> rate_Hz;
  bool json = false;
};

// Returns the files of each tool. Throws InputError if one of them is an input or another output,
// or if several tools would share a pipe.
std::vector<ToolFiles> output_files(const TouchOptions& options) {
  std::vector<std::filesystem::path> inputs(options.paths.begin(), options.paths.end());
  inputs.emplace_back(options.scene);
  std::vector<ToolFiles> files;
  std::vector<std::filesystem::path> outputs;
  for (std::size_t i = 0; i < options.paths.size(); ++i) {
    files.push_back({.rows = file_of_tool(options.output, i),
                     .steps = file_of_tool(options.explain, i),
                     .hashes = file_of_tool(options.hashes, i)});
    outputs.push_back(files.back().rows);
    outputs.push_back(files.back().steps);
    outputs.push_back(files.back().hashes);
  }
  outputs.emplace_back(options.bodies.places);
  outputs.emplace_back(options.bodies.energy);
  refuse_shared_pipe(options.output, files.size());
  refuse_shared_pipe(options.explain, files.size());
  refuse_shared_pipe(options.hashes, files.size());
  keep_inputs_safe(outputs, inputs);
  return files;
}

// Reads the paths, warns of those in millimetres, and samples them at the rate, if there is one.
ToolPaths read_paths(const TouchOptions& options) {
  std::vector<ToolPath> paths;
  for (const std::string& file : options.paths) {
    const ToolPath rows(file);
    if (const std::optional<std::string> warning = rows.warning()) {
      fmt::print(stderr, "tactus touch: warning: {}\n", *warning);
    }
    paths.push_back(options.rate_Hz ? rows.sampled(*options.rate_Hz) : rows);
  }
  return ToolPaths(std::move(paths));
}

// Prints the summary of one tool: to standard error if the rows go to standard output.
void print(const std::string& output, bool json, const TouchSummary& s) {
  std::FILE* const out = is_standard_output(output) ? stderr : stdout;
  if (json) {
    const nlohmann::ordered_json object{{"output", output},
                                        {"ticks", s.ticks},
                                        {"contact_ticks", s.contact_ticks},
                                        {"flagged_ticks", s.flagged_ticks},
                                        {"max_force_N", s.max_force_N},
                                        {"max_depth_m", s.max_depth_m},
                                        {"max_short_of_goal_m", s.max_short_of_goal_m}};
    fmt::print(out, "{}\n", object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    return;
  }
  fmt::print(out, "{}: {} ticks, {} in contact, largest force {:.4g} N, largest depth {:.4g} mm\n",
             output, s.ticks, s.contact_ticks, s.max_force_N, 1e3 * s.max_depth_m);
  if (s.flagged_ticks > 0) {
    fmt::print(
        out,
        "{} ticks gave something up to a limit (rendering/limits.h); they ended at most {:.4g} "
        "mm short of their goal\n",
        s.flagged_ticks, 1e3 * s.max_short_of_goal_m);
  }
}

void run(const TouchOptions& options) {
  const std::vector<ToolFiles> files = output_files(options);
  const MappedScene scene(options.scene);
  const ToolPaths paths = read_paths(options);
  const auto world = world_of_tools(scene.image(), paths.tools(), options.scene);
  std::deque<ToolRecord> records;
  for (const ToolFiles& own : files) {
    records.emplace_back(own, scene.image().tool_radius_m());
  }
  BodyFiles bodies(options.bodies, scene.image());
  {
    ProgressLine progress;
    follow_paths(*world, paths, records, bodies, [&](std::size_t ticks) {
      progress.step(fmt::format("{} of {} ticks", ticks, paths.size()));
    });
    std::ranges::for_each(records, &ToolRecord::close);
    bodies.close();
  }
  for (std::size_t i = 0; i < records.size(); ++i) {
    print(files[i].rows.string(), options.json, records[i].summary());
  }
}

}  // namespace

void add_touch_verb(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("touch", "Replay tool positions against a scene, without dynamics");
  const auto options = std::make_shared<TouchOptions>();
  verb->add_option("scene", options->scene, "Scene image (.tactus)")->required();
  verb->add_option("--path", options->paths, "Tool positions (CSV); once for each tool, up to ten")
      ->required()
      ->allow_extra_args(false);
  verb->add_option("--rate", options->rate_Hz,
                   "Ticks in a second; the path is straight from row to row. Without it one row is "
                   "one tick")
      ->check(CLI::PositiveNumber);
  verb->add_option(
          "-o,--output", options->output,
          "Write one row a tick to this CSV file; those of a second tool to NAME.2.csv, and "
          "so on")
      ->required();
  verb->add_option(
      "--explain", options->explain,
      "Write every step of every tick to this CSV file (host_tools/explain/README.md); those of a "
      "second tool to NAME.2.csv, and so on");
  verb->add_option("--hashes", options->hashes,
                   "Write the state hash of every tick to this file; those of a second tool to "
                   "NAME.2.csv, and so on");
  verb->add_option("--bodies", options->bodies.places,
                   "Write where each body is at each tick to this CSV file");
  verb->add_option("--body-energy", options->bodies.energy,
                   "Write the energy of each body, and the work of the hands on it, to this CSV "
                   "file");
  verb->add_flag("--json", options->json, "Print the summary as one JSON object for each tool");
  verb->footer(kTouchExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
