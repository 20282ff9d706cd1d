#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "host_tools/plot/figures.h"
#include "host_tools/plot/gnuplot.h"

namespace tactus::host {
namespace {

// More points than pixels change nothing that can be seen.
constexpr std::size_t kMostForcePoints = 12000;

// Returns the end of an axis that starts at zero, a little above the curve.
double axis_top(double largest, double least_top) {
  return std::max(1.1 * largest, least_top);
}

// Returns the end of the last row's tick, so that it is drawn whole.
double end_s(const std::vector<RunRow>& rows) {
  const double step_s = rows.size() > 1 ? rows.back().t_s - rows[rows.size() - 2].t_s : 1e-3;
  return rows.back().t_s + step_s;
}

std::string time_series(const std::vector<RunRow>& rows) {
  std::string block = "$run << EOD\n";
  for (const std::size_t i : thin(rows, kMostForcePoints)) {
    const RunRow& row = rows[i];
    fmt::format_to(std::back_inserter(block), "{:.6g} {:.6g} {:.6g} {:.6g}\n", row.t_s, row.force_N,
                   row.commanded_N, 1e3 * row.depth_m);
  }
  return block + "EOD\n";
}

// Returns the stretches as gnuplot's data. The first line lies far left of the axis: it keeps
// gnuplot from failing, and the key complete, when there is no stretch at all.
std::string background(std::string_view name, const std::vector<Stretch>& bands) {
  std::string block = fmt::format("${} << EOD\n-1e9 -1e9 -1e9\n", name);
  for (const Stretch& band : bands) {
    fmt::format_to(std::back_inserter(block), "{:.6g} {:.6g} {:.6g}\n",
                   0.5 * (band.from_s + band.to_s), band.from_s, band.to_s);
  }
  return block + "EOD\n";
}

constexpr std::string_view kForceHead = R"gnuplot(
set xrange [{first:.6g}:{last:.6g}]
set border 3 linecolor "#555555"
set tics nomirror out textcolor "#333333"
set grid ytics linecolor "#e3e3e3" linewidth 0.7 linetype 1
set lmargin at screen 0.075
set rmargin at screen 0.975
set key at screen 0.975,0.945 right top horizontal samplen 2.2 textcolor "#333333" width 1
set style fill solid 1.0 noborder
set label 1 {title} at screen 0.075,0.968 left font ",18" textcolor "#111111" noenhanced
)gnuplot";

constexpr std::string_view kForcePanel = R"gnuplot(
set tmargin at screen 0.89
set bmargin at screen 0.50
set format x ""
set ylabel "force on the hand (N)" textcolor "#333333" offset 0.5
set yrange [0:{top:.6g}]
plot $stick using 1:(0):2:3:(0):({top:.6g}) with boxxyerror linecolor "#d3e5f6" title "stick", \
     $slip using 1:(0):2:3:(0):({top:.6g}) with boxxyerror linecolor "#fde5cb" title "slip", \
     {commanded}$run using 1:2 with lines linecolor "#17406d" linewidth 1.6 title "rendered force"
unset label 1
)gnuplot";

constexpr std::string_view kCommandedCurve =
    R"($run using 1:3 with lines linecolor "#d0421b" linewidth 1.6 title "after safety limits", )";

constexpr std::string_view kDepthPanel = R"gnuplot(
set tmargin at screen 0.465
set bmargin at screen 0.085
set format x "%g"
set xlabel "time (s)" textcolor "#333333"
set ylabel "depth (mm)" textcolor "#333333" offset 0.5
set yrange [0:{top:.6g}]
unset key
plot $stick using 1:(0):2:3:(0):({top:.6g}) with boxxyerror linecolor "#d3e5f6", \
     $slip using 1:(0):2:3:(0):({top:.6g}) with boxxyerror linecolor "#fde5cb", \
     $run using 1:4 with lines linecolor "#17406d" linewidth 1.6
)gnuplot";

}  // namespace

void draw_force_figure(const RunData& run, const std::string& title,
                       const std::filesystem::path& picture) {
  double force_N = 0.0;
  double depth_mm = 0.0;
  for (const RunRow& row : run.rows) {
    force_N = std::max({force_N, row.force_N, row.commanded_N});
    depth_mm = std::max(depth_mm, 1e3 * row.depth_m);
  }
  const double first_s = run.rows.front().t_s;
  const double last_s = end_s(run.rows);
  std::string script = time_series(run.rows);
  script += background("stick", stretches(run.rows, rendering::FrictionState::stick));
  script += background("slip", stretches(run.rows, rendering::FrictionState::slip));
  const GnuplotFolder folder;
  script += fmt::format(kForceHead, fmt::arg("first", first_s), fmt::arg("last", last_s),
                        fmt::arg("title", gnuplot_string(title)));
  script +=
      fmt::format(kForcePanel, fmt::arg("top", axis_top(force_N, 0.1)),
                  fmt::arg("commanded", run.has_commanded ? kCommandedCurve : std::string_view{}));
  script += fmt::format(kDepthPanel, fmt::arg("top", axis_top(depth_mm, 0.1)));
  run_gnuplot(folder, {.width_px = 1600, .height_px = 1000}, script, picture);
}

}  // namespace tactus::host
