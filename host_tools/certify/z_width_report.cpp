#include "host_tools/certify/z_width_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>

#include "host_tools/files/atomic_file.h"

namespace tactus::host {
namespace {

// Returns the lowest limit of all hands at that damping.
const StableStiffness& least_limit(const ZWidth& z_width, std::size_t damping) {
  return std::ranges::min_element(
             z_width.curves, {},
             [&](const ZWidthCurve& curve) { return curve.limits[damping].stiffness_N_per_m; })
      ->limits[damping];
}

}  // namespace

void write_z_width_csv(const ZWidth& z_width, const std::filesystem::path& csv) {
  std::string text = "damping_Ns_per_m";
  for (const ZWidthCurve& curve : z_width.curves) {
    text += fmt::format(",stiffness_{}_N_per_m", curve.hand);
  }
  text += ",certified_N_per_m\n";
  for (std::size_t i = 0; i < z_width.dampings_Ns_per_m.size(); ++i) {
    text += fmt::format("{:.6g}", z_width.dampings_Ns_per_m[i]);
    for (const ZWidthCurve& curve : z_width.curves) {
      text += fmt::format(",{:.6g}", curve.limits[i].stiffness_N_per_m);
    }
    text += i < z_width.certificate.count
                ? fmt::format(",{:.6g}\n", z_width.certificate.points[i].stiffness_N_per_m)
                : ",\n";
  }
  write_file_atomically(csv, std::as_bytes(std::span(text)));
}

std::string z_width_table(const ZWidth& z_width, const CertifiedDevice& device) {
  std::string text = fmt::format("{:>10}", "N s/m");
  for (const ZWidthCurve& curve : z_width.curves) {
    text += fmt::format("{:>10}", curve.hand);
  }
  text += fmt::format("{:>12}  {}\n", "certified", "worst");
  for (std::size_t i = 0; i < z_width.dampings_Ns_per_m.size(); ++i) {
    text += fmt::format("{:>10.3g}", z_width.dampings_Ns_per_m[i]);
    for (const ZWidthCurve& curve : z_width.curves) {
      text += fmt::format("{:>10.0f}", curve.limits[i].stiffness_N_per_m);
    }
    const bool is_certified = i < z_width.certificate.count;
    fmt::format_to(
        std::back_inserter(text), "{:>12}  {}\n",
        is_certified ? fmt::format("{:.0f}", z_width.certificate.points[i].stiffness_N_per_m) : "-",
        device.places[least_limit(z_width, i).worst].where);
  }
  return text;
}

firmware::CertifiedPoint stiffest_certified(const firmware::StiffnessCertificate& certificate) {
  return *std::ranges::max_element(certificate.all(), {},
                                   &firmware::CertifiedPoint::stiffness_N_per_m);
}

}  // namespace tactus::host
