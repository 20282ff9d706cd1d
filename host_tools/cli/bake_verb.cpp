#include "host_tools/cli/bake_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "host_tools/bake/device/certificate_file.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/bake/scene/bake.h"
#include "host_tools/cli/bake_report.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/output_place.h"
#include "host_tools/reach/reach_summary.h"

namespace tactus::host {
namespace {

constexpr const char* kBakeExamples =
    "The files and their keys are described in host_tools/bake/README.md. A file with a "
    "[mechanism]\n"
    "is a device, any other a scene.\n"
    "\n"
    "Examples:\n"
    "  tactus bake scene.toml                     writes scene.tactus beside it\n"
    "  tactus bake scene.toml -o /tmp/s.tactus    writes where you say\n"
    "  tactus bake device.toml                    writes device.tactus, for tactusd\n"
    "  tactus bake scene.toml --quiet             prints warnings and errors alone\n"
    "  tactus bake scene.toml --json | jq '.objects[].open_edges'";

// The verb's options as the user gave them.
struct BakeOptions {
  std::string scene;
  std::string output;
  bool json = false;
  bool quiet = false;
};

nlohmann::ordered_json to_json(const ObjectReport& object) {
  return {{"name", object.name},
          {"mesh", object.mesh},
          {"triangles", object.triangles},
          {"vertices", object.vertices},
          {"dropped_triangles", object.counters.degenerate_triangles},
          {"welded_vertices", object.counters.welded_vertices},
          {"open_edges", object.counters.open_edges},
          {"non_manifold_edges", object.counters.non_manifold_edges},
          {"inconsistent_edges", object.counters.inconsistent_edges},
          {"lines_and_points", object.lines_and_points},
          {"bytes", object.bytes},
          {"bytes_per_triangle",
           static_cast<double>(object.bytes) / static_cast<double>(object.triangles)},
          {"seconds", object.seconds},
          {"warnings", object.warnings}};
}

void print_json(const BakeReport& report) {
  nlohmann::ordered_json json{{"image", report.image},
                              {"tool_radius_m", report.tool_radius_m},
                              {"bytes", report.bytes},
                              {"seconds", report.seconds},
                              {"objects", nlohmann::ordered_json::array()}};
  for (const ObjectReport& object : report.objects) {
    json["objects"].push_back(to_json(object));
  }
  fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

// Bakes a device file. Its certificate is an input too, and must not be overwritten.
void run_device(const BakeOptions& options, const std::filesystem::path& output) {
  keep_inputs_safe({output}, {options.scene, certificate_path(options.scene)});
  const LoadedDevice device = bake_device(options.scene);
  write_file_atomically(output, device.image());
  for (const std::string& warning : device.warnings()) {
    fmt::print(stderr, "tactus bake: warning: {}\n", warning);
  }
  for (const std::string& warning : device_warnings(device.config())) {
    fmt::print(stderr, "tactus bake: warning: {}: {}\n", options.scene, warning);
  }
  if (options.json) {
    const firmware::DeviceConfig& config = device.config();
    const nlohmann::ordered_json json{{"image", output.string()},
                                      {"bytes", device.image().size()},
                                      {"joints", config.joint_count},
                                      {"axes", config.axis_count},
                                      {"connections", config.connection_count},
                                      {"rate_hz", config.controller.rate_hz},
                                      {"certified", config.certification.limits.exists()}};
    fmt::print("{}\n", json.dump());
  } else if (!options.quiet) {
    fmt::print("{}: {} bytes, {}\n", output.string(), device.image().size(),
               in_words(device.config()));
  }
}

// A file with a [mechanism] is a device, any other a scene.
void run(const BakeOptions& options) {
  const std::filesystem::path output =
      options.output.empty() ? std::filesystem::path(options.scene).replace_extension(".tactus")
                             : std::filesystem::path(options.output);
  if (describes_device(options.scene)) {
    run_device(options, output);
    return;
  }
  const BakeReport report =
      options.quiet ? bake_file(options.scene, output) : bake_with_progress(options.scene, output);
  print_bake_warnings("bake", report);
  if (options.json) {
    print_json(report);
  } else if (!options.quiet) {
    print_bake_table(report);
  }
}

}  // namespace

void add_bake_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "bake", "Turn a scene file and its meshes, or a device file, into an image");
  const auto options = std::make_shared<BakeOptions>();
  verb->add_option("scene", options->scene, "Scene or device file (TOML)")->required();
  verb->add_option("-o,--output", options->output,
                   "Image to write; default: the file's name with .tactus");
  verb->add_flag("--json", options->json, "Print the report as one JSON object");
  verb->add_flag("-q,--quiet", options->quiet, "Print nothing but warnings and errors");
  verb->footer(kBakeExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
