#include "host_tools/cli/bake_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "host_tools/bake/bake_json.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/bake/scene/bake.h"
#include "host_tools/cli/bake_report.h"
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

// Bakes a device file.
void run_device(const BakeOptions& options, const std::filesystem::path& output) {
  const LoadedDevice device = bake_device_file(options.scene, output);
  for (const std::string& warning : device.warnings()) {
    fmt::print(stderr, "tactus bake: warning: {}\n", warning);
  }
  for (const std::string& warning : device_warnings(device.config())) {
    fmt::print(stderr, "tactus bake: warning: {}: {}\n", options.scene, warning);
  }
  if (options.json) {
    fmt::print("{}\n", bake_json(device, output));
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
    fmt::print("{}\n", bake_json(report));
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
