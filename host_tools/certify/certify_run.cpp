#include "host_tools/certify/certify_run.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host_tools/bake/device/certificate_file.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/certify/z_width_report.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// A larger margin certifies next to nothing and is surely a slip.
constexpr double kMostMargin = 100.0;

void check_choice(const CertifyChoice& choice) {
  if (!(choice.margin >= 1.0) || choice.margin > kMostMargin) {
    throw InputError(
        fmt::format("--margin {}: write a number from 1 to {}", choice.margin, kMostMargin));
  }
  if (choice.dampings < 2 || choice.dampings > firmware::kMaxCertifiedPoints) {
    throw InputError(fmt::format("--dampings {}: write a number from 2 to {}", choice.dampings,
                                 firmware::kMaxCertifiedPoints));
  }
}

CertifyFiles files_of(const std::filesystem::path& device) {
  const auto beside = [&](const char* extension) {
    return std::filesystem::path(device).replace_extension(extension);
  };
  return {.certificate = certificate_path(device),
          .csv = beside(".zwidth.csv"),
          .png = beside(".zwidth.png")};
}

}  // namespace

Certification certify_file(const std::filesystem::path& file, const CertifyChoice& choice,
                           const CertifyProgress& progress) {
  check_choice(choice);
  if (!describes_device(file)) {
    throw InputError(fmt::format(
        "{}: is no device, it has no [mechanism]; certify takes a device.toml", file.string()));
  }
  const LoadedDevice loaded = bake_device(file);
  Certification found{
      .z_width = {}, .device = certified_device(loaded.config()), .files = files_of(file)};
  const ZWidthOptions sweep{
      .dampings = choice.dampings, .margin = choice.margin, .threads = choice.threads};
  found.z_width = measure_z_width(found.device, sweep, progress);
  const std::string name(loaded.config().name);
  write_z_width_csv(found.z_width, found.files.csv);
  draw_z_width(found.z_width, name.empty() ? "this device" : name, found.device.measured_with,
               found.files.png);
  write_certificate(found.files.certificate, found.z_width.certificate, found.device.measured_with,
                    loaded.settings_checksum());
  return found;
}

std::string certification_json(const Certification& certification) {
  const auto& [z_width, device, files] = certification;
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
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace tactus::host
