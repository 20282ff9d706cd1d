#include "host_tools/cli/certify_verb.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "host_tools/certify/certify_run.h"
#include "host_tools/certify/z_width_report.h"
#include "host_tools/cli/progress_line.h"

namespace tactus::host {
namespace {

constexpr const char* kCertifyExamples =
    "Presses the simulated device against walls of every stiffness and damping, with the hand off "
    "and on, at\n"
    "several places of its workspace, through the real controller. What it finds out goes into "
    "three files beside\n"
    "the device's: arm.certificate.toml, which tactus bake puts into the image and by which "
    "tactusd "
    "refuses scenes\n"
    "that are too stiff; arm.zwidth.csv and arm.zwidth.png. What the device weighs, and how its "
    "joints rub, stands in\n"
    "[plant]. host_tools/certify/README.md says what counts as stable.\n"
    "\n"
    "Examples:\n"
    "  tactus certify arm.toml && tactus bake arm.toml\n"
    "  tactus certify arm.toml --margin 2            half of what was found to be stable\n"
    "  tactus certify arm.toml --dampings 16 --json | jq .certified";

// The verb's options as the user gave them.
struct CertifyOptions {
  std::string device;
  CertifyChoice choice;
  bool json = false;
};

Certification certify_with_progress(const CertifyOptions& options) {
  if (::isatty(STDERR_FILENO) != 1) {
    return certify_file(options.device, options.choice);
  }
  ProgressLine line;
  return certify_file(options.device, options.choice,
                      [&](std::string_view what, std::size_t done, std::size_t all) {
                        line.step(fmt::format("{}: {} of {}", what, done, all));
                      });
}

void print_text(const Certification& found, const std::string& name) {
  const auto& [z_width, device, files] = found;
  const firmware::CertifiedPoint peak = stiffest_certified(z_width.certificate);
  fmt::print("{}\n{}", device.measured_with, z_width_table(z_width, device));
  fmt::print(
      "largest safe stiffness {:.0f} N/m with a damping of {:.3g} N s/m, {:.0f} N/m without; "
      "margin {:.3g}\n",
      peak.stiffness_N_per_m, peak.damping_Ns_per_m,
      firmware::certified_stiffness(z_width.certificate, 0.0), z_width.certificate.margin);
  fmt::print("{}\n{}\n{}\nnow put it into the image: tactus bake {}\n", files.certificate.string(),
             files.csv.string(), files.png.string(), name);
}

void run(const CertifyOptions& options) {
  const Certification found = certify_with_progress(options);
  if (options.json) {
    fmt::print("{}\n", certification_json(found));
  } else {
    print_text(found, options.device);
  }
}

}  // namespace

void add_certify_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "certify", "Find out how stiff a surface a device holds, on the simulated device");
  const auto options = std::make_shared<CertifyOptions>();
  verb->add_option("device", options->device, "Device file (TOML)")->required();
  verb->add_option("--margin", options->choice.margin,
                   "What was found to be stable is divided by this, 1 to 100")
      ->capture_default_str();
  verb->add_option("--dampings", options->choice.dampings,
                   "How many dampings are looked at, 2 to 16")
      ->capture_default_str();
  verb->add_option("--threads", options->choice.threads, "Default: one a processor");
  verb->add_flag("--json", options->json, "Print the result as one JSON object");
  verb->footer(kCertifyExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
