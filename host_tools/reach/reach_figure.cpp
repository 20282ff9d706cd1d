#include "host_tools/reach/reach_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "host_tools/plot/gnuplot.h"
#include "host_tools/reach/reach_cut.h"

namespace tactus::host {
namespace {

constexpr double kReachWidth_px = 1500.0;
constexpr double kReachRow_px = 620.0;
constexpr double kReachHead_px = 110.0;

// Returns the range of a panel's colours: that of nine tenths of the places, so that the few at the
// edge of the reach, where it grows without bound, do not wash out the rest.
std::pair<double, double> colour_range(std::vector<double> values) {
  constexpr double kTail = 0.05;
  if (values.empty()) {
    return {0.0, 1.0};
  }
  std::ranges::sort(values);
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const double lower = at(kTail);
  const double upper = at(1.0 - kTail);
  const double least = std::max(0.1 * upper, 1e-6);
  return upper - lower > least ? std::pair(lower, upper) : std::pair(lower - least, upper + least);
}

// Returns a closed rectangle as rows of gnuplot.
std::string rectangle(const ReachCut& cut, const ReachBox& box) {
  const Vec3 a = 1e3 * box.lower_B;
  const Vec3 b = 1e3 * box.upper_B;
  return fmt::format(
      "{0:.5g} {1:.5g}\n{2:.5g} {1:.5g}\n{2:.5g} {3:.5g}\n{0:.5g} {3:.5g}\n{0:.5g} "
      "{1:.5g}\n\n",
      a[cut.right], a[cut.up], b[cut.right], b[cut.up]);
}

// Yellow is good: few see no difference of lightness.
constexpr std::string_view kReachPanel = R"gnuplot(
set palette defined ({palette}) maxcolors 12
set border 3 linecolor "#555555"
set tics nomirror out textcolor "#333333"
set size ratio -1
set lmargin at screen {left:.5f}
set rmargin at screen {right:.5f}
set bmargin at screen {bottom:.5f}
set tmargin at screen {top:.5f}
set xrange [{x0:.6g}:{x1:.6g}]
set yrange [{y0:.6g}:{y1:.6g}]
set cbrange [{c0:.6g}:{c1:.6g}]
set format cb "{format}"
set xlabel {xlabel} textcolor "#333333"
set ylabel {ylabel} textcolor "#333333" offset 1.2
set cblabel {clabel} textcolor "#333333" offset 0.9
set colorbox user origin screen {bar:.5f},{bottom:.5f} size screen 0.013,{bar_height:.5f}
unset key
plot {items}
)gnuplot";

constexpr std::string_view kFewIsGood =
    R"(0 "#fde725", 0.25 "#5ec962", 0.5 "#21918c", 0.75 "#3b528b", 1 "#440154")";
constexpr std::string_view kMuchIsGood =
    R"(0 "#440154", 0.25 "#3b528b", 0.5 "#21918c", 0.75 "#5ec962", 1 "#fde725")";

// One panel: its place on the sheet, its quantity and its cut.
struct ReachPanel {
  const ReachCut& cut;
  const CutWindow& window;
  std::size_t row = 0;
  bool is_force = false;
  std::size_t rows = 0;
  bool has_objects = false;
  bool is_arc = false;
};

// The titles and, since the key of a narrow panel has no room, the meaning of its marks.
constexpr std::string_view kReachTitles = R"gnuplot(
set label 1 {title} at screen 0.075,{title_y:.5f} left font ",19" textcolor "#111111" noenhanced
set label 2 {subtitle} at screen 0.075,{subtitle_y:.5f} left font ",12" textcolor "#666666" noenhanced
set label 3 '┅ workspace' at screen 0.66,{title_y:.5f} left font ",13" textcolor "#111111" noenhanced
set label 4 '● origin of scenes' at screen 0.78,{title_y:.5f} left font ",13" textcolor "#d0421b" noenhanced
set label 5 {objects} at screen 0.66,{subtitle_y:.5f} left font ",13" textcolor "#d0421b" noenhanced
)gnuplot";

std::string panel_script(const ReachPanel& panel, const SampledCut& sampled) {
  const double height_px = kReachHead_px + kReachRow_px * static_cast<double>(panel.rows);
  const double top =
      1.0 - (kReachHead_px + kReachRow_px * static_cast<double>(panel.row)) / height_px;
  const double bottom = top - (kReachRow_px - 100.0) / height_px;
  const double left = panel.is_force ? 0.575 : 0.075;
  const double width = 0.325;
  // The window has the shape of the panel, so that the picture fills it.
  const double panel_ratio = (width * kReachWidth_px) / ((top - bottom) * height_px);
  const CutWindow& w = panel.window;
  const double grown_mm = std::max(w.width_mm, w.height_mm * panel_ratio);
  const double tall_mm = grown_mm / panel_ratio;
  const double x0 = w.right_mm - 0.5 * (grown_mm - w.width_mm);
  const double y0 = w.up_mm - 0.5 * (tall_mm - w.height_mm);
  const auto [c0, c1] = colour_range(panel.is_force ? sampled.forces_N : sampled.resolutions_um);
  const std::string data = fmt::format("${}{}", panel.is_force ? "force" : "resolution", panel.row);
  std::string items =
      panel.is_arc ? fmt::format(
                         "{} using 1:2:3 with points pointtype 7 pointsize 1.3 linecolor palette "
                         "notitle",
                         data)
                   : fmt::format("{} using 1:2:3 with image notitle", data);
  items += fmt::format(
      ", $box{0} using 1:2 with lines linewidth 2.6 linecolor \"#ffffff\" notitle, $box{0} using "
      "1:2 "
      "with lines linewidth 1.6 dashtype 2 linecolor \"#111111\" notitle, $origin{0} "
      "using 1:2 with points pointtype 7 pointsize 1.9 linecolor \"#ffffff\" notitle, $origin{0} "
      "using 1:2 with points pointtype 7 pointsize 1.2 linecolor \"#d0421b\" notitle",
      panel.row);
  if (panel.has_objects) {
    items += fmt::format(
        ", $objects{} using 1:2 with lines linewidth 2.2 linecolor \"#d0421b\" notitle", panel.row);
  }
  const double y1 = y0 + tall_mm;
  return fmt::format(
      kReachPanel, fmt::arg("palette", panel.is_force ? kMuchIsGood : kFewIsGood),
      fmt::arg("left", left), fmt::arg("right", left + width), fmt::arg("bottom", bottom),
      fmt::arg("top", top), fmt::arg("x0", x0), fmt::arg("x1", x0 + grown_mm),
      fmt::arg("y0", panel.cut.is_down ? y1 : y0), fmt::arg("y1", panel.cut.is_down ? y0 : y1),
      fmt::arg("c0", c0), fmt::arg("c1", c1),
      fmt::arg("format", c1 - c0 >= 8.0 ? "%.0f" : (c1 - c0 >= 0.8 ? "%.1f" : "%.2f")),
      fmt::arg("xlabel", gnuplot_string(panel.cut.right_label)),
      fmt::arg("ylabel", gnuplot_string(panel.cut.up_label)),
      fmt::arg("clabel", panel.is_force ? "'force in every direction (N)'"
                                        : "'one encoder count at the handle (µm)'"),
      fmt::arg("bar", left + width + 0.012), fmt::arg("bar_height", top - bottom),
      fmt::arg("items", items));
}

// Returns the data blocks of a row.
std::string row_blocks(const ReachMap& map, const ReachCut& cut,
                       std::span<const ObjectReach> objects, const SampledCut& sampled,
                       std::size_t row) {
  const PlantParameters& plant = map.device().device.plant;
  const Vec3 origin_mm = 1e3 * map.config().controller.workspace_origin_D;
  std::string outlines;
  for (const ObjectReach& object : objects) {
    outlines += rectangle(cut, object.box_B);
  }
  return fmt::format(
      "$resolution{0} << EOD\n{1}EOD\n$force{0} << EOD\n{2}EOD\n$box{0} << EOD\n{3}EOD\n$origin{0} "
      "<< EOD\n{4:.5g} {5:.5g}\nEOD\n$objects{0} << EOD\n{6}EOD\n",
      row, sampled.resolution_um, sampled.force_N,
      rectangle(cut, {.lower_B = plant.stop_lower_B, .upper_B = plant.stop_upper_B}),
      origin_mm[cut.right], origin_mm[cut.up], outlines);
}

}  // namespace

void draw_reach(const ReachMap& map, std::span<const ObjectReach> objects, const std::string& title,
                const std::string& subtitle, const std::filesystem::path& picture) {
  const GnuplotFolder folder;
  const ReachBox box = map.whole_box();
  const bool is_arc = map.config().joint_count == 1;
  const std::vector<ReachCut> cuts = cuts_of(map.config().joint_count);
  const double height_px = kReachHead_px + kReachRow_px * static_cast<double>(cuts.size());
  std::string script =
      fmt::format(kReachTitles, fmt::arg("title", gnuplot_string(title)),
                  fmt::arg("title_y", 1.0 - 0.3 * kReachHead_px / height_px),
                  fmt::arg("subtitle", gnuplot_string(subtitle)),
                  fmt::arg("subtitle_y", 1.0 - 0.62 * kReachHead_px / height_px),
                  fmt::arg("objects", objects.empty() ? "''" : "'▭ objects of the scene'"));
  for (std::size_t row = 0; row < cuts.size(); ++row) {
    const ReachCut& cut = cuts[row];
    const CutWindow window = window_of(cut, box);
    const SampledCut sampled = is_arc ? sample_arc(map) : sample_plane(map, cut, window);
    script += row_blocks(map, cut, objects, sampled, row);
    for (const bool is_force : {false, true}) {
      script += panel_script({.cut = cut,
                              .window = window,
                              .row = row,
                              .is_force = is_force,
                              .rows = cuts.size(),
                              .has_objects = !objects.empty(),
                              .is_arc = is_arc},
                             sampled);
      script += "unset label\n";
    }
  }
  run_gnuplot(folder, {.width_px = kReachWidth_px, .height_px = height_px}, script, picture);
}

}  // namespace tactus::host
