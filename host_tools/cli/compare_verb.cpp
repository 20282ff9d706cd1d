#include "host_tools/cli/compare_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/cli/picture_option.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/compare/compare_figure.h"
#include "host_tools/compare/compared_run.h"
#include "host_tools/compare/run_figures.h"
#include "host_tools/compare/variant.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/touch/tool_path.h"
#include "host_tools/touch/touch_csv.h"
#include "host_tools/units.h"
#include "rendering/friction/registered_models.h"
#include "rendering/objects/contact_method.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {
namespace {

constexpr const char* kCompareExamples =
    "Takes scene.toml, not an image, and bakes it anew for each run. The path is that of `tactus "
    "touch`. Lists are\n"
    "multiplied: two methods at three rates are six runs. host_tools/compare/README.md explains "
    "the columns of the\n"
    "table, host_tools/bake/README.md the contact methods.\n"
    "\n"
    "Examples:\n"
    "  tactus compare scene.toml --path path.csv --methods one_plane,three_sub_goals,god_object\n"
    "  tactus compare scene.toml --path path.csv --methods one_step,three_step --from 0.4 --to "
    "0.42 --picture ripple.png\n"
    "  tactus compare scene.toml --path path.csv --friction cone,dahl,lugre --csv runs/\n"
    "  tactus compare scene.toml --path path.csv --methods three_step --push-outs 0,0.001,0.5\n"
    "  tactus compare scene.toml --path path.csv --rates 500,1000,4000 --json | jq "
    "'.runs[].ripple_N'";

// The verb's options as the user gave them.
struct CompareOptions {
  std::string scene;
  std::string path;
  VariantLists lists;
  std::string object;
  std::string picture;
  std::string csv;
  TimeSpan span{.from_s = -std::numeric_limits<double>::infinity(),
                .to_s = std::numeric_limits<double>::infinity()};
  bool json = false;
};

// Prints the table; the columns are as wide as their longest text.
void print_table(const std::vector<ComparedRun>& runs, const std::vector<RunFigures>& figures) {
  constexpr double kMillijoules = 1000.0;
  std::vector<std::vector<std::string>> rows{
      {"", "contact", "", "force", "jump", "ripple", "given out", "moves", "above", "below", "off",
       "force off"},
      {"run", "ticks", "breaks", "N", "N", "N", "mJ", "mean / most", "mm", "mm", "mm", "N"}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunFigures& f = figures[i];
    const auto text = [](double number) { return fmt::format("{:.3g}", number); };
    rows.push_back({runs[i].name, fmt::format("{}", f.contact_ticks), fmt::format("{}", f.breaks),
                    text(f.largest_force_N), text(f.largest_jump_N), text(f.ripple_N),
                    text(kMillijoules * f.given_out_J),
                    fmt::format("{:.2g} / {}", f.mean_moves, f.most_moves),
                    text(kMillimetresPerMetre * f.above_m), text(kMillimetresPerMetre * f.below_m),
                    text(kMillimetresPerMetre * f.off_m), text(f.force_off_N)});
  }
  std::vector<std::size_t> widths(rows.front().size());
  for (const std::vector<std::string>& row : rows) {
    for (std::size_t column = 0; column < row.size(); ++column) {
      widths[column] = std::max(widths[column], row[column].size());
    }
  }
  for (const std::vector<std::string>& row : rows) {
    std::string line = fmt::format("{:<{}}", row.front(), widths.front());
    for (std::size_t column = 1; column < row.size(); ++column) {
      line += fmt::format("  {:>{}}", row[column], widths[column]);
    }
    fmt::print("{}\n", line);
  }
}

void print_json(const CompareOptions& options, const std::vector<ComparedRun>& runs,
                const std::vector<RunFigures>& figures) {
  nlohmann::ordered_json json{
      {"scene", options.scene}, {"path", options.path}, {"runs", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunFigures& f = figures[i];
    json["runs"].push_back({{"name", runs[i].name},
                            {"ticks", runs[i].ticks.size()},
                            {"contact_ticks", f.contact_ticks},
                            {"breaks", f.breaks},
                            {"largest_force_N", f.largest_force_N},
                            {"largest_jump_N", f.largest_jump_N},
                            {"ripple_N", f.ripple_N},
                            {"given_out_J", f.given_out_J},
                            {"mean_moves", f.mean_moves},
                            {"most_moves", f.most_moves},
                            {"above_m", f.above_m},
                            {"below_m", f.below_m},
                            {"off_m", f.off_m},
                            {"force_off_N", f.force_off_N}});
  }
  fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

// Writes each run as `tactus touch` does, into a folder, which is made if it is missing.
void write_runs(const CompareOptions& options, const std::vector<ComparedRun>& runs) {
  const std::filesystem::path folder(options.csv);
  for (const ComparedRun& run : runs) {
    std::string name = run.name;
    std::ranges::replace(name, ' ', '_');
    std::erase(name, ',');
    const std::filesystem::path file = folder / (name + ".csv");
    keep_inputs_safe({file}, {options.scene, options.path});
    make_folder_of(file);
    TouchCsv csv(file);
    for (const ComparedTick& tick : run.ticks) {
      csv.add(tick.t_s, tick.tool_W, tick.touch);
    }
    csv.close();
  }
}

// Returns the name of a file with its folder, if it has one.
std::string title_of(const std::filesystem::path& file) {
  return (file.parent_path().filename() / file.filename()).string();
}

void draw_picture(const CompareOptions& options, const SceneDescription& scene,
                  const std::vector<ComparedRun>& runs, const Progress& progress) {
  const BakedImage baked = bake_scene(scene, progress);
  if (const auto image = rendering::SceneImage::open(baked.bytes)) {
    draw_comparison(runs, options.span, image->objects(),
                    fmt::format("{}, {}", title_of(options.scene),
                                std::filesystem::path(options.path).filename().string()),
                    options.picture);
  }
}

void run_comparison(const CompareOptions& options) {
  keep_inputs_safe({options.picture}, {options.scene, options.path});
  if (!options.scene.ends_with(".toml")) {
    throw InputError(fmt::format("{}: compare bakes the scene anew for each run; name scene.toml",
                                 options.scene));
  }
  const std::vector<Variant> variants = variants_of(options.lists);
  const SceneDescription scene = read_scene_description(options.scene);
  const ToolPath path(options.path);
  if (const std::optional<std::string> warning = path.warning()) {
    fmt::print(stderr, "tactus compare: warning: {}\n", *warning);
  }
  std::optional<ProgressLine> line(std::in_place);
  const Progress progress = [&line](std::string_view step) { line->step(step); };
  std::vector<ComparedRun> runs;
  std::vector<RunFigures> figures;
  runs.reserve(variants.size());
  figures.reserve(variants.size());
  for (const Variant& variant : variants) {
    const ToolPath own = variant.rate_Hz ? path.sampled(*variant.rate_Hz) : path;
    runs.push_back(follow(variant.name, changed(scene, variant, options.object), own, progress));
  }
  for (const ComparedRun& run : runs) {
    figures.push_back(figures_of(run, runs.front(), options.span));
  }
  if (!options.csv.empty()) {
    write_runs(options, runs);
  }
  if (!options.picture.empty()) {
    draw_picture(options, scene, runs, progress);
  }
  line.reset();
  options.json ? print_json(options, runs, figures) : print_table(runs, figures);
}

// Returns the names of a table's entries, with commas.
template <class Table>
std::string names_of(const Table& table) {
  std::vector<std::string_view> names;
  names.reserve(table.size());
  for (const auto& entry : table) {
    names.push_back(entry.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void add_compare_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "compare", "Follow one path by several contact methods, friction models, push-outs or rates");
  const auto options = std::make_shared<CompareOptions>();
  verb->add_option("scene", options->scene, "Scene (scene.toml)")->required();
  verb->add_option("--path", options->path, "Tool positions (CSV)")->required();
  verb->add_option("--methods", options->lists.methods,
                   "Contact methods, with commas: " + names_of(rendering::kContactMethods))
      ->delimiter(',');
  verb->add_option("--friction", options->lists.frictions,
                   "Friction models, with commas: " + names_of(rendering::kFrictionModels))
      ->delimiter(',');
  verb->add_option("--push-outs", options->lists.push_outs_mm,
                   "Push-outs of the textbook's methods, mm, with commas")
      ->delimiter(',');
  verb->add_option("--sides", options->lists.sides,
                   "Sides that stop the tool: one,two is one-way against two-way")
      ->delimiter(',');
  verb->add_option("--rates", options->lists.rates_Hz,
                   "Ticks in a second, with commas; the path is straight from row to row")
      ->delimiter(',');
  verb->add_option("--object", options->object,
                   "Change this object alone; by default all objects of the scene");
  verb->add_option("--from", options->span.from_s, "Count and draw from this time on, s");
  verb->add_option("--to", options->span.to_s, "Count and draw up to this time, s");
  verb->add_option("--picture", options->picture,
                   "Draw the runs over each other into this .png, .svg or .pdf file")
      ->check(picture_complaint);
  verb->add_option("--csv", options->csv, "Write the CSV file of each run into this folder");
  verb->add_flag("--json", options->json, "Print the table as one JSON object");
  verb->footer(kCompareExamples);
  verb->callback([options] { run_comparison(*options); });
}

}  // namespace tactus::host
