#include "host_tools/cli/certify_verb.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "host_tools/bake/device/certificate_file.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/certify/z_width_report.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/input_error.h"

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
  double margin = ZWidthOptions{}.margin;
  std::size_t dampings = ZWidthOptions{}.dampings;
  unsigned threads = 0;
  bool json = false;
};

// A larger margin certifies next to nothing and is surely a slip.
constexpr double kMostMargin = 100.0;

ZWidth measure_with_progress(const CertifyOptions& options, const CertifiedDevice& device) {
  const ZWidthOptions sweep{
      .dampings = options.dampings, .margin = options.margin, .threads = options.threads};
  if (::isatty(STDERR_FILENO) != 1) {
    return measure_z_width(device, sweep);
  }
  ProgressLine line;
  return measure_z_width(device, sweep,
                         [&](std::string_view what, std::size_t done, std::size_t all) {
                           line.step(fmt::format("{}: {} of {}", what, done, all));
                         });
}

// The three files that the verb writes beside the device's.
struct CertifyFiles {
  std::filesystem::path certificate;
  std::filesystem::path csv;
  std::filesystem::path png;
};

CertifyFiles files_of(const std::filesystem::path& device) {
  const auto beside = [&](const char* extension) {
    return std::filesystem::path(device).replace_extension(extension);
  };
  return {certificate_path(device), beside(".zwidth.csv"), beside(".zwidth.png")};
}

void print_json(const ZWidth& z_width, const CertifiedDevice& device, const CertifyFiles& files) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const firmware::CertifiedPoint& point : z_width.certificate.all()) {
    points.push_back({{"damping_Ns_per_m", point.damping_Ns_per_m},
                      {"stiffness_N_per_m", point.stiffness_N_per_m}});
  }
  const firmware::CertifiedPoint peak = stiffest_certified(z_width.certificate);
  const nlohmann::ordered_json json{{"largest_safe_stiffness_N_per_m", peak.stiffness_N_per_m},
                                    {"at_damping_Ns_per_m", peak.damping_Ns_per_m},
                                    {"margin", z_width.certificate.margin},
                                    {"certified", points},
                                    {"measured_with", device.measured_with},
                                    {"certificate", files.certificate.string()},
                                    {"csv", files.csv.string()},
                                    {"picture", files.png.string()}};
  fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void print_text(const ZWidth& z_width, const CertifiedDevice& device, const CertifyFiles& files,
                const std::string& name) {
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
  if (!(options.margin >= 1.0) || options.margin > kMostMargin) {
    throw InputError(
        fmt::format("--margin {}: write a number from 1 to {}", options.margin, kMostMargin));
  }
  if (options.dampings < 2 || options.dampings > firmware::kMaxCertifiedPoints) {
    throw InputError(fmt::format("--dampings {}: write a number from 2 to {}", options.dampings,
                                 firmware::kMaxCertifiedPoints));
  }
  if (!describes_device(options.device)) {
    throw InputError(fmt::format(
        "{}: is no device, it has no [mechanism]; certify takes a device.toml", options.device));
  }
  const LoadedDevice loaded = bake_device(options.device);
  const CertifiedDevice device = certified_device(loaded.config());
  const ZWidth z_width = measure_with_progress(options, device);
  const CertifyFiles files = files_of(options.device);
  const std::string name(loaded.config().name);
  write_z_width_csv(z_width, files.csv);
  draw_z_width(z_width, name.empty() ? "this device" : name, device.measured_with, files.png);
  write_certificate(files.certificate, z_width.certificate, device.measured_with,
                    loaded.settings_checksum());
  if (options.json) {
    print_json(z_width, device, files);
  } else {
    print_text(z_width, device, files, options.device);
  }
}

}  // namespace

void add_certify_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "certify", "Find out how stiff a surface a device holds, on the simulated device");
  const auto options = std::make_shared<CertifyOptions>();
  verb->add_option("device", options->device, "Device file (TOML)")->required();
  verb->add_option("--margin", options->margin,
                   "What was found to be stable is divided by this, 1 to 100")
      ->capture_default_str();
  verb->add_option("--dampings", options->dampings, "How many dampings are looked at, 2 to 16")
      ->capture_default_str();
  verb->add_option("--threads", options->threads, "Default: one a processor");
  verb->add_flag("--json", options->json, "Print the result as one JSON object");
  verb->footer(kCertifyExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
