#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "host_tools/certify/z_width_report.h"
#include "host_tools/plot/gnuplot.h"

namespace tactus::host {
namespace {

constexpr double kZWidthWidth = 1200;
constexpr double kZWidthHeight = 800;

// The colours go from dark to light, with the most important hand first, so that they differ in
// grey too.
constexpr std::array<std::string_view, 5> kHandColours{"#d0421b", "#17406d", "#4c7fb0", "#8fb3d3",
                                                       "#8e6bb3"};

constexpr std::string_view kZWidthHead = R"gnuplot(
set border 3 linecolor "#555555"
set tics nomirror out textcolor "#333333"
set grid linecolor "#e3e3e3" linewidth 0.7 linetype 1
set lmargin at screen 0.095
set rmargin at screen 0.97
set tmargin at screen 0.815
set bmargin at screen 0.105
set xrange [0:{right:.6g}]
set yrange [0:{top:.6g}]
set format y "%.0f"
set xlabel "damping of the wall (N s/m)" textcolor "#333333"
set ylabel "stiffness of the wall (N/m)" textcolor "#333333" offset 0.5
set label 1 {title} at screen 0.095,0.962 left font ",19" textcolor "#111111" noenhanced
set label 2 {first_line} at screen 0.095,0.925 left font ",11" textcolor "#666666" noenhanced
set label 3 {second_line} at screen 0.095,0.900 left font ",11" textcolor "#666666" noenhanced
set label 4 {peak} at {peak_x:.6g},{peak_y:.6g} center offset 0,-1.2 font ",13" textcolor "#2c6e49" front noenhanced
set key at screen 0.97,0.825 right bottom horizontal maxrows 1 textcolor "#333333" samplen 2.2 width 1 noenhanced
plot $certified using 1:2 with filledcurves y1=0 linecolor "#d9ecdf" title "certified", \
     $certified using 1:2 with lines linewidth 2.2 linecolor "#2c6e49" notitle)gnuplot";

std::string certified_block(const firmware::StiffnessCertificate& certificate) {
  std::string block = "$certified << EOD\n";
  for (const firmware::CertifiedPoint& point : certificate.all()) {
    fmt::format_to(std::back_inserter(block), "{:.7g} {:.7g}\n", point.damping_Ns_per_m,
                   point.stiffness_N_per_m);
  }
  return block + "EOD\n";
}

std::string curve_block(const ZWidth& z_width, std::size_t curve) {
  std::string block = fmt::format("$hand_{} << EOD\n", curve);
  for (std::size_t i = 0; i < z_width.dampings_Ns_per_m.size(); ++i) {
    fmt::format_to(std::back_inserter(block), "{:.7g} {:.7g}\n", z_width.dampings_Ns_per_m[i],
                   z_width.curves[curve].limits[i].stiffness_N_per_m);
  }
  return block + "EOD\n";
}

// Returns the largest stiffness of all curves, N/m.
double most_of(const ZWidth& z_width) {
  double most = 0.0;
  for (const ZWidthCurve& curve : z_width.curves) {
    for (const StableStiffness& limit : curve.limits) {
      most = std::max(most, limit.stiffness_N_per_m);
    }
  }
  return most;
}

// Splits a text at a comma near its middle, to fill two lines.
std::array<std::string, 2> halves(const std::string& text) {
  const std::size_t comma = text.rfind(", ", text.size() / 2 + 8);
  return comma == std::string::npos ? std::array{text, std::string()}
                                    : std::array{text.substr(0, comma + 1), text.substr(comma + 2)};
}

}  // namespace

void draw_z_width(const ZWidth& z_width, const std::string& device_name,
                  const std::string& measured_with, const std::filesystem::path& picture) {
  const firmware::CertifiedPoint peak = stiffest_certified(z_width.certificate);
  const auto [first_line, second_line] = halves(measured_with);
  std::string script = certified_block(z_width.certificate);
  for (std::size_t i = 0; i < z_width.curves.size(); ++i) {
    script += curve_block(z_width, i);
  }
  const GnuplotFolder folder;
  script += fmt::format(
      kZWidthHead, fmt::arg("right", std::max(1.0, z_width.dampings_Ns_per_m.back())),
      fmt::arg("top", 1.06 * most_of(z_width)),
      fmt::arg("title", gnuplot_string(fmt::format("Walls that {} holds", device_name))),
      fmt::arg("first_line", gnuplot_string(first_line)),
      fmt::arg("second_line", gnuplot_string(second_line)),
      fmt::arg("peak", gnuplot_string(fmt::format("{:.0f} N/m", peak.stiffness_N_per_m))),
      fmt::arg("peak_x", peak.damping_Ns_per_m), fmt::arg("peak_y", peak.stiffness_N_per_m));
  for (std::size_t i = 0; i < z_width.curves.size(); ++i) {
    script += fmt::format(
        ", \\\n     $hand_{} using 1:2 with linespoints pointtype 7 pointsize 0.9 linewidth 1.7 "
        "linecolor \"{}\" title {}",
        i, kHandColours.at(i % kHandColours.size()),
        gnuplot_string(fmt::format("hand: {}", z_width.curves[i].hand)));
  }
  run_gnuplot(folder, {.width_px = kZWidthWidth, .height_px = kZWidthHeight}, script, picture);
}

}  // namespace tactus::host
