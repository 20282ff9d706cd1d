#include "host_tools/cli/doctor_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <utility>

#include "host_tools/bake/device/device_bake.h"
#include "host_tools/doctor/doctor.h"
#include "host_tools/input_error.h"
#include "host_tools/terminal_colour.h"

namespace tactus::host {
namespace {

constexpr const char* kDoctorExamples =
    "Looks at the kernel, at what this user may do, at the processors, and at the interfaces that "
    "devices hang on.\n"
    "Changes nothing. Below a line that is not well stands the command that mends it.\n"
    "Exit codes: 0 all well, 1 something to mend, 2 something could not be looked at.\n"
    "\n"
    "Examples:\n"
    "  tactus doctor                        this machine, and whatever is plugged in\n"
    "  tactus doctor arm.toml               this machine, and what that device needs of it\n"
    "  tactus doctor --json | jq 'select(.state == \"mend\")'\n"
    "  tactus doctor --save board           records what was looked at, to be sent to someone\n"
    "  tactus doctor --root board           examines a recorded machine";

// The verb's options as the user gave them.
struct DoctorOptions {
  std::string device;
  std::string root;
  std::string save;
  bool json = false;
};

// Reads a device that is baked already. Throws InputError.
LoadedDevice load_image(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    throw InputError(name + ": no such file, or not readable");
  }
  const std::string content = std::move(text).str();
  const auto bytes = std::as_bytes(std::span(content));
  return {{bytes.begin(), bytes.end()}, name};
}

// Returns what a device needs of the machine, or the needs of any device without a file.
Needs needs_of_file(const std::string& name) {
  if (name.empty()) {
    return needs_of_any_device();
  }
  const bool baked = std::filesystem::path(name).extension() == ".tactus";
  const LoadedDevice device = baked ? load_image(name) : bake_device(name);
  return needs_of(device.config());
}

void run(const DoctorOptions& options) {
  const Needs needs = needs_of_file(options.device);
  Machine machine = options.root.empty() ? Machine() : Machine(options.root);
  const Findings findings = examine(machine, needs);
  fmt::print("{}", options.json ? in_json(findings) : in_words(findings, has_colour(stdout)));
  if (!options.save.empty()) {
    machine.save(options.save);
  }
  if (const int code = exit_code(findings); code != 0) {
    throw CLI::RuntimeError(code);
  }
}

}  // namespace

void add_doctor_verb(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("doctor", "Say whether this machine can run the controller on time");
  const auto options = std::make_shared<DoctorOptions>();
  verb->add_option("device", options->device, "Device (.toml or .tactus); default: any");
  auto* root = verb->add_option("--root", options->root, "Folder of a recorded machine");
  verb->add_option("--save", options->save, "Record what was looked at in this folder")
      ->excludes(root);
  verb->add_flag("--json", options->json, "Print one JSON object a line");
  verb->footer(kDoctorExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
