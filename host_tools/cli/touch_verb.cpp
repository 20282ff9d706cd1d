#include "host_tools/cli/touch_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/csv/csv_table.h"
#include "host_tools/explain/explainer.h"
#include "host_tools/explain/steps_csv.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/simulation/run_log.h"
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
    "  tactus touch scene.tactus --path path.csv --output /dev/stdout | cut -d, -f1,8-10\n"
    "  tactus touch scene.tactus --path path.csv --output out.csv --json | jq .max_force_N";

constexpr std::string_view kHeader =
    "t_s,tool_x_m,tool_y_m,tool_z_m,proxy_x_m,proxy_y_m,proxy_z_m,force_x_N,force_y_N,force_z_N,"
    "contact,depth_m,friction_state,normal_x,normal_y,normal_z,object,flags,short_of_goal_m\n";

// The verb's options as the user gave them.
struct TouchOptions {
  std::string scene;
  std::string path;
  std::string output;
  std::string explain;
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

// The tool's positions from a file, with velocities by backward differences.
class ToolPath {
 public:
  explicit ToolPath(const std::string& file) : table_(CsvTable::read(file, kColumns)) {
    const auto t = table_.column("t_s");
    for (std::size_t row = 1; row < table_.rows(); ++row) {
      if (t[row] <= t[row - 1]) {
        throw InputError(fmt::format(
            "{}:{}: column t_s: {} does not come after {}; time must grow from row to row", file,
            table_.line(row), t[row], t[row - 1]));
      }
    }
  }

  // Returns a warning that names the first row where the tool is farther from the world's origin
  // than hands reach; nothing if there is none.
  [[nodiscard]] std::optional<std::string> warning(const std::string& file) const {
    constexpr double kReach_m = 5.0;
    for (std::size_t row = 0; row < size(); ++row) {
      const double distance_m = position(row).norm();
      if (distance_m > kReach_m) {
        return fmt::format(
            "{}:{}: the tool is {:.4g} m from the world's origin; if the file has millimetres, "
            "divide its positions by 1000",
            file, table_.line(row), distance_m);
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::size_t size() const { return table_.rows(); }
  [[nodiscard]] double time_s(std::size_t row) const { return table_.column("t_s")[row]; }
  // Returns the tool at a row, world frame, m and m/s; at rest in the first row.
  [[nodiscard]] rendering::ToolState tool(std::size_t row) const {
    const Vec3 p = position(row);
    const Vec3 v = row == 0 ? Vec3{Vec3::Zero()}
                            : Vec3{(p - position(row - 1)) / (time_s(row) - time_s(row - 1))};
    return {.p_W = p, .v_W = v};
  }

 private:
  static constexpr std::array<std::string_view, 4> kColumns{"t_s", "x_m", "y_m", "z_m"};

  [[nodiscard]] Vec3 position(std::size_t row) const {
    return {table_.column("x_m")[row], table_.column("y_m")[row], table_.column("z_m")[row]};
  }

  CsvTable table_;
};

void append(std::string& line, const Vec3& v) {
  fmt::format_to(std::back_inserter(line), ",{},{},{}", v.x(), v.y(), v.z());
}

// Appends the row of a tick.
void write_row(LogFile& file, double t_s, const Vec3& tool, const rendering::Touch& touch) {
  std::string& line = file.buffer();
  fmt::format_to(std::back_inserter(line), "{}", t_s);
  append(line, tool);
  append(line, touch.proxy_W);
  append(line, touch.force_W);
  fmt::format_to(std::back_inserter(line), ",{},{},{}", static_cast<int>(touch.contact),
                 touch.depth_m, static_cast<int>(touch.friction));
  append(line, touch.normal_W);
  if (touch.contact == rendering::ContactKind::none) {
    line += ',';
  } else {
    fmt::format_to(std::back_inserter(line), ",{}", touch.object);
  }
  fmt::format_to(std::back_inserter(line), ",{},{}\n", touch.flags, touch.short_of_goal_m);
  file.flush_if_full();
}

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
  const ToolPath path(options.path);
  if (const std::optional<std::string> warning = path.warning(options.path)) {
    fmt::print(stderr, "tactus touch: warning: {}\n", *warning);
  }
  const auto world = std::make_unique<rendering::World>();
  if (!world->set_scene(scene.image().objects(), rendering::world_of(scene.image()))) {
    throw InputError(fmt::format("{}: the world refuses the scene; bake it again", options.scene));
  }
  LogFile file(options.output, kHeader);
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
      world->set_tick(path.time_s(row) - path.time_s(row - 1));
    }
    explainer.begin();
    const rendering::Touch touch = world->touch(tool, steps ? &explainer : nullptr);
    if (steps) {
      steps->add(explainer.finish(row, path.time_s(row), tool.p_W, touch));
    }
    write_row(file, path.time_s(row), tool.p_W, touch);
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
