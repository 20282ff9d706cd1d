#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "hal/angle.h"
#include "host_tools/plot/figures.h"
#include "host_tools/plot/gnuplot.h"

namespace tactus::host {
namespace {

// Returns the angle between the forces of two ticks, degrees; 0 if one of them is zero.
double turn_deg(const RunRow& before, const RunRow& now) {
  if (!(before.force_N > 0.0) || !(now.force_N > 0.0)) {
    return 0.0;
  }
  const double sine = before.force_W.cross(now.force_W).norm();
  return hal::degrees_of(std::atan2(sine, before.force_W.dot(now.force_W)));
}

// Returns a run as gnuplot's data: time, force, and turn since the row before.
std::string data_block(std::string_view name, const RunData& run) {
  std::string block = fmt::format("${} << EOD\n", name);
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const RunRow& row = run.rows[i];
    fmt::format_to(std::back_inserter(block), "{:.6g} {:.6g} {:.6g}\n", row.t_s, row.force_N,
                   i == 0 ? 0.0 : turn_deg(run.rows[i - 1], row));
  }
  return block + "EOD\n";
}

double largest_turn_deg(const RunData& run) {
  double largest = 0.0;
  for (std::size_t i = 1; i < run.rows.size(); ++i) {
    largest = std::max(largest, turn_deg(run.rows[i - 1], run.rows[i]));
  }
  return largest;
}

double largest_force_N(const RunData& run) {
  return std::ranges::max_element(run.rows, {}, &RunRow::force_N)->force_N;
}

constexpr std::string_view kScript = R"gnuplot(
set xrange [{first:.6g}:{last:.6g}]
set border 3 linecolor "#555555"
set tics nomirror out textcolor "#333333"
set grid ytics linecolor "#e3e3e3" linewidth 0.7 linetype 1
set lmargin at screen 0.095
set rmargin at screen 0.975
set key at screen 0.975,0.97 right top horizontal samplen 2.2 textcolor "#333333" noenhanced
set tmargin at screen 0.89
set bmargin at screen 0.52
set format x ""
set ylabel "force on the hand (N)" textcolor "#333333" offset 0.5
set yrange [0:{force_top:.6g}]
plot $other using 1:2 with lines linecolor "#d0421b" linewidth 1.5 title {other_name}, \
     $run using 1:2 with lines linecolor "#17406d" linewidth 1.5 title {run_name}
unset key
set tmargin at screen 0.47
set bmargin at screen 0.13
set format x "%g"
set xlabel "time (s)" textcolor "#333333"
set ylabel "turn in a tick (degrees)" textcolor "#333333" offset 0.5
set yrange [0:{turn_top:.6g}]
plot $other using 1:3 with impulses linecolor "#d0421b" linewidth 1.2, \
     $run using 1:3 with lines linecolor "#17406d" linewidth 1.5
)gnuplot";

}  // namespace

void draw_against_figure(const NamedRun& run, const NamedRun& other,
                         const std::filesystem::path& picture) {
  // Room above the curves, and the least height of an axis.
  constexpr double kAir = 1.1;
  constexpr double kLeastTop = 0.1;
  const double force_top = std::max(largest_force_N(run.run), largest_force_N(other.run));
  const double turn_top = std::max(largest_turn_deg(run.run), largest_turn_deg(other.run));
  std::string script = data_block("run", run.run) + data_block("other", other.run);
  const GnuplotFolder folder;
  script += fmt::format(
      kScript, fmt::arg("first", std::min(run.run.rows.front().t_s, other.run.rows.front().t_s)),
      fmt::arg("last", std::max(run.run.rows.back().t_s, other.run.rows.back().t_s) + 1e-3),
      fmt::arg("force_top", std::max(kAir * force_top, kLeastTop)),
      fmt::arg("turn_top", std::max(kAir * turn_top, kLeastTop)),
      fmt::arg("run_name", gnuplot_string(run.name)),
      fmt::arg("other_name", gnuplot_string(other.name)));
  run_gnuplot(folder, {.width_px = 1200, .height_px = 700}, script, picture);
}

}  // namespace tactus::host
