#include "host_tools/bake/device/certificate_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>
#include <vector>

#include "firmware/device_file/device_certificate.h"
#include "host_tools/files/atomic_file.h"

namespace tactus::host {

std::filesystem::path certificate_path(const std::filesystem::path& device) {
  std::filesystem::path path = device;
  return path.replace_extension(".certificate.toml");
}

std::filesystem::path commissioning_path(const std::filesystem::path& device) {
  std::filesystem::path path = device;
  return path.replace_extension(".commissioning.toml");
}

void write_certificate(const std::filesystem::path& file,
                       const firmware::StiffnessCertificate& certificate,
                       const std::string& measured_with, std::uint64_t settings_checksum) {
  std::vector<double> dampings;
  std::vector<double> stiffnesses;
  for (const firmware::CertifiedPoint& point : certificate.all()) {
    dampings.push_back(point.damping_Ns_per_m);
    stiffnesses.push_back(point.stiffness_N_per_m);
  }
  const std::string text = fmt::format(
      "# Written by tactus certify, for tactus bake. The stiffest surface, by its damping, that "
      "the "
      "device holds.\n"
      "[certificate]\n"
      "{} = [{}]\n{} = [{}]\n{} = {}\n{} = \"{}\"\n{} = \"{}\"\n",
      firmware::kCertificateDampings, fmt::join(dampings, ", "), firmware::kCertificateStiffnesses,
      fmt::join(stiffnesses, ", "), firmware::kCertificateMargin, certificate.margin,
      firmware::kCertificateMethod, measured_with, firmware::kCertificateSettings,
      firmware::checksum_text(settings_checksum).view());
  write_file_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace tactus::host
