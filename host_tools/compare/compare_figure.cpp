#include "host_tools/compare/compare_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string_view>

#include "host_tools/plot/gnuplot.h"
#include "host_tools/plot/mesh_cut.h"
#include "host_tools/plot/silhouette.h"
#include "host_tools/units.h"

namespace tactus::host {
namespace {

constexpr double kCompareWidth = 1500.0;
constexpr double kCompareHeight = 760.0;

// The plane of the world in which the figure is drawn.
struct CutPlane {
  // The axes to the right and up, and the one across the plane.
  Eigen::Index right = 0;
  Eigen::Index up = 1;
  Eigen::Index across = 2;
  // The place of the plane on the axis across it, m.
  double place_m = 0.0;

  // Returns a point in the picture, mm.
  [[nodiscard]] PlanePoint point(const Vec3& p_W) const {
    return {.right = kMillimetresPerMetre * p_W[right], .up = kMillimetresPerMetre * p_W[up]};
  }
};

char axis_name(Eigen::Index axis) {
  return "xyz"[axis];
}

// Calls `visit` with each tick of the runs that counts.
template <class Visit>
void for_ticks(std::span<const ComparedRun> runs, const TimeSpan& span, const Visit& visit) {
  for (const ComparedRun& run : runs) {
    for (const ComparedTick& tick : run.ticks) {
      if (span.holds(tick.t_s)) {
        visit(tick);
      }
    }
  }
}

// Returns the plane through the middle of the tool's path along its two longest axes.
CutPlane plane_of(std::span<const ComparedRun> runs, const TimeSpan& span) {
  Vec3 lower = Vec3::Constant(1e9);
  Vec3 upper = -lower;
  for_ticks(runs, span, [&](const ComparedTick& tick) {
    lower = lower.cwiseMin(tick.tool_W).cwiseMin(tick.touch.proxy_W);
    upper = upper.cwiseMax(tick.tool_W).cwiseMax(tick.touch.proxy_W);
  });
  CutPlane plane;
  (upper - lower).minCoeff(&plane.across);
  plane.right = plane.across == 0 ? 2 : 0;
  plane.up = plane.across == 1 ? 2 : 1;
  plane.place_m = 0.5 * (lower + upper)[plane.across];
  return plane;
}

// Returns a square window that holds the tools and the proxies with a margin, mm.
Window window_of(std::span<const ComparedRun> runs, const TimeSpan& span, const CutPlane& plane) {
  constexpr double kHalfWithMargin = 0.6;
  constexpr double kLeastWidth_mm = 0.01;
  Window window;
  for_ticks(runs, span, [&](const ComparedTick& tick) {
    window.include(plane.point(tick.tool_W));
    window.include(plane.point(tick.touch.proxy_W));
  });
  return square_about(window, kHalfWithMargin, kLeastWidth_mm);
}

// Returns gnuplot's data block of the lines in which the plane cuts the objects.
std::string cut_block(std::span<const rendering::Object> objects, const CutPlane& plane) {
  std::string block = "$cut << EOD\n";
  for (const rendering::Object& object : objects) {
    for (const CutLine& line : cut_lines(object.mesh, [&plane](const Vec3& p_W) {
           return p_W[plane.across] - plane.place_m;
         })) {
      const PlanePoint a = plane.point(line[0]);
      const PlanePoint b = plane.point(line[1]);
      fmt::format_to(std::back_inserter(block), "{:.8g} {:.8g}\n{:.8g} {:.8g}\n\n", a.right, a.up,
                     b.right, b.up);
    }
  }
  return block + "1e9 1e9\nEOD\n";
}

// Returns the data block of a run: time, force, distance from the first run, proxy, tool. Raises
// `most_off_mm` to the largest distance.
std::string run_block(std::size_t index, const ComparedRun& run, const ComparedRun& first,
                      const TimeSpan& span, const CutPlane& plane, double& most_off_mm) {
  std::string block = fmt::format("$run{} << EOD\n", index);
  for (const ComparedTick& tick : run.ticks) {
    if (!span.holds(tick.t_s)) {
      continue;
    }
    const PlanePoint proxy = plane.point(tick.touch.proxy_W);
    const PlanePoint tool = plane.point(tick.tool_W);
    const double off_mm = kMillimetresPerMetre * distance_from(tick, first);
    most_off_mm = std::max(most_off_mm, off_mm);
    fmt::format_to(std::back_inserter(block), "{:.9g} {:.7g} {:.7g} {:.8g} {:.8g} {:.8g} {:.8g}\n",
                   tick.t_s, tick.touch.force_W.norm(), off_mm, proxy.right, proxy.up, tool.right,
                   tool.up);
  }
  return block + "EOD\n";
}

// The style of each run in its order. Colours that differ in brightness too, for people who see few
// colours; thinner lines lie over thicker ones, so that equal curves are all seen.
std::string style_of(std::size_t index, std::size_t runs, bool has_points) {
  constexpr std::array<std::string_view, 6> kColours{"#17406d", "#d0421b", "#4c9a78",
                                                     "#b8860b", "#8e6bb3", "#2f2f2f"};
  const double width = 1.4 + 1.3 * static_cast<double>(runs - 1 - index);
  return fmt::format("with {} linecolor \"{}\" linewidth {:.3g} dashtype {}{}",
                     has_points ? "linespoints" : "lines", kColours.at(index % kColours.size()),
                     std::min(width, 6.0), index < kColours.size() ? 1 : 2,
                     has_points ? " pointtype 7 pointsize 0.5" : "");
}

// Returns the curves of all runs with the columns of the data blocks.
std::string curves(std::span<const ComparedRun> runs, std::string_view columns, bool has_points) {
  std::string text;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    text += fmt::format("{}$run{} using {} {} notitle", i == 0 ? "" : ", \\\n     ", i, columns,
                        style_of(i, runs.size(), has_points));
  }
  return text;
}

// Returns curves that are nowhere to be seen, with the names of the runs.
std::string key_of(std::span<const ComparedRun> runs, bool has_points) {
  std::string text;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    text += fmt::format("{}9 {} title {}", i == 0 ? "" : ", \\\n     ",
                        style_of(i, runs.size(), has_points), gnuplot_string(runs[i].name));
  }
  return text;
}

constexpr std::string_view kCompareScript = R"gnuplot(
set encoding utf8
set border 3 linecolor "#555555"
set tics nomirror out textcolor "#333333"
set label 1 {title} at screen 0.06,0.97 left font ",18" textcolor "#111111" noenhanced
set lmargin at screen 0.075
set rmargin at screen 0.47
set bmargin at screen 0.11
set tmargin at screen 0.89
set size ratio -1
set xrange [{x0:.8g}:{x1:.8g}]
set yrange [{y0:.8g}:{y1:.8g}]
set xlabel '{x_name} (mm)' textcolor "#333333"
set ylabel '{y_name} (mm)' textcolor "#333333" offset 0.5
unset key
plot $cut using 1:2 with lines linecolor "#9a9a9a" linewidth 4, \
     $run0 using 6:7 with lines linecolor "#777777" linewidth 1.3 dashtype 3, \
     {paths}
unset label 1
set size noratio
set grid ytics linecolor "#e3e3e3" linewidth 0.7 linetype 1
set lmargin at screen 0.565
set rmargin at screen 0.97
set tmargin at screen 0.88
set bmargin at screen 0.53
set xrange [{from:.9g}:{to:.9g}]
set yrange [0:*]
set format x ""
unset xlabel
set ylabel 'force on the hand (N)' textcolor "#333333"
plot {forces}
set tmargin at screen 0.48
set bmargin at screen 0.11
set format x "%g"
set xlabel 'time (s)' textcolor "#333333"
set ylabel 'proxy from that of the first (mm)' textcolor "#333333"
set yrange [0:{most_off:.6g}]
plot {distances}
set lmargin at screen 0.02
set rmargin at screen 0.98
set bmargin at screen 0.90
set tmargin at screen 0.95
unset border
unset tics
unset xlabel
unset ylabel
unset grid
set xrange [0:1]
set yrange [0:1]
set key center center horizontal width 1 samplen 3 textcolor "#333333" noenhanced
plot 9 with lines linecolor "#777777" linewidth 1.3 dashtype 3 title 'tool', \
     {key}
)gnuplot";

}  // namespace

void draw_comparison(std::span<const ComparedRun> runs, const TimeSpan& span,
                     std::span<const rendering::Object> objects, const std::string& title,
                     const std::filesystem::path& picture) {
  // Fewer ticks than this are marked one by one, and the least height of the axis of distances, mm.
  constexpr std::ptrdiff_t kFewTicks = 120;
  constexpr double kLeastOff_mm = 1e-3;
  constexpr double kAir = 1.1;
  const CutPlane plane = plane_of(runs, span);
  const Window window = window_of(runs, span, plane);
  std::string script = cut_block(objects, plane);
  double most_off_mm = kLeastOff_mm;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    script += run_block(i, runs[i], runs.front(), span, plane, most_off_mm);
  }
  const bool has_points = std::ranges::count_if(runs.front().ticks, [&](const ComparedTick& tick) {
                            return span.holds(tick.t_s);
                          }) < kFewTicks;
  const std::vector<ComparedTick>& ticks = runs.front().ticks;
  const GnuplotFolder folder;
  script += fmt::format(
      kCompareScript, fmt::arg("title", gnuplot_string(title)), fmt::arg("x0", window.lower.right),
      fmt::arg("x1", window.upper.right), fmt::arg("y0", window.lower.up),
      fmt::arg("y1", window.upper.up), fmt::arg("x_name", axis_name(plane.right)),
      fmt::arg("y_name", axis_name(plane.up)),
      fmt::arg("from", std::max(span.from_s, ticks.front().t_s)),
      fmt::arg("to", std::min(span.to_s, ticks.back().t_s)),
      fmt::arg("most_off", kAir * most_off_mm), fmt::arg("paths", curves(runs, "4:5", has_points)),
      fmt::arg("forces", curves(runs, "1:2", has_points)),
      fmt::arg("distances", curves(runs, "1:3", has_points)),
      fmt::arg("key", key_of(runs, has_points)));
  run_gnuplot(folder, {.width_px = kCompareWidth, .height_px = kCompareHeight}, script, picture);
}

}  // namespace tactus::host
