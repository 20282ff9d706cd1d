#include "host_tools/cli/plot_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <vector>

#include "host_tools/cli/plot_scene.h"
#include "host_tools/csv/csv_table.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/plot/bodies_strip.h"
#include "host_tools/plot/figures.h"
#include "rendering/limits.h"

namespace tactus::host {
namespace {

// Returns true if the file's heading is that of --bodies.
bool is_of_bodies(const std::string& file) {
  const std::string heading = csv_heading(file);
  return heading.find("body") != std::string::npos && heading.find("qw") != std::string::npos;
}

// Returns the number of pictures. Throws InputError.
std::size_t columns_of(const std::string& text) {
  std::size_t columns = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, columns);
  if (error != std::errc{} || stopped != end || columns < kFewestColumns ||
      columns > kMostColumns) {
    throw InputError(fmt::format(
        "--frames {}: give the number of pictures in the strip, {} to {}; for frames of --explain "
        "give --ticks, too",
        text, kFewestColumns, kMostColumns));
  }
  return columns;
}

// Returns the runs of all tools: the first one's, and those beside it that have its times.
std::vector<RunData> runs_of(const std::string& first) {
  std::vector<RunData> runs{read_run(first)};
  for (std::size_t tool = 1; tool < rendering::kMaxTools; ++tool) {
    const std::filesystem::path file = file_of_tool(first, tool);
    if (!std::filesystem::exists(file)) {
      break;
    }
    RunData run = read_run(file);
    // A file of an earlier run with more tools may lie there.
    if (run.rows.size() != runs.front().rows.size()) {
      break;
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

void plot_bodies(const BodiesPlotOptions& options) {
  const std::size_t columns = columns_of(options.frames);
  const bool is_alone = options.bodies.empty();
  if (is_alone && !is_of_bodies(options.run)) {
    throw InputError(fmt::format(
        "--frames draws bodies, and {} has none: write them with tactus touch --bodies bodies.csv "
        "or tactus sim --bodies bodies.csv, and give that file by --bodies",
        options.run));
  }
  const std::string& file = is_alone ? options.run : options.bodies;
  const PlotScene scene(options.scene, options.run);
  const auto bodies = static_cast<std::size_t>(std::ranges::count_if(
      scene.image().objects(), [](const rendering::Object& object) { return is_body(object); }));
  const std::vector<BodiesFrame> frames = read_bodies(file, bodies);
  const std::vector<RunData> runs = is_alone ? std::vector<RunData>{} : runs_of(options.run);
  const std::filesystem::path csv(file);
  const std::filesystem::path picture =
      figure_file(options.output, csv.stem().string(), "_frames", options.format);
  keep_inputs_safe({picture}, {options.run, file, options.scene});
  make_folder_of(picture);
  draw_bodies_strip({.objects = scene.image().objects(),
                     .frames = frames,
                     .tools = runs,
                     .tool_radius_m = scene.image().tool_radius_m(),
                     .columns = columns,
                     .title = fmt::format(
                         "{}: tools with the force on the hand; bodies with x red, y green, z blue",
                         std::filesystem::path(options.scene.empty() ? options.run : options.scene)
                             .stem()
                             .string())},
                    picture);
  fmt::print("{}\n", picture.string());
}

}  // namespace tactus::host
