#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ranges>

#include "host_tools/plot/figures.h"
#include "host_tools/plot/gnuplot.h"

namespace tactus::host {
namespace {

// More points change nothing that can be seen.
constexpr std::size_t kMostPathPoints = 40000;

// The sheet, in pixels: two panels side by side with room for their axes, and a colour bar at the
// right.
constexpr double kSheetWidth = 1800.0;
constexpr double kPanelBottom = 105.0;
constexpr double kTitleHeight = 75.0;
constexpr double kLeft = 105.0;
constexpr double kGap = 125.0;
constexpr double kRight = 175.0;
constexpr double kLargestPanelHeight = 1400.0;

// One view and its place on the sheet.
struct Panel {
  View view = View::front;
  // In mm.
  Window window;
  // In pixels, like `right`.
  double left = 0.0;
  double right = 0.0;
};

// The layout of the figure.
struct Sheet {
  Panel front;
  Panel side;
  // The upper edge of the panels, pixels.
  double top = 0.0;
  // The height of the sheet, pixels.
  double height = 0.0;
};

// Turns metres into millimetres.
void scale_to_mm(Window& window) {
  for (PlanePoint* point : {&window.lower, &window.upper}) {
    point->right *= 1e3;
    point->up *= 1e3;
  }
}

// Returns the window that holds the scene and the path, with a margin, mm.
Window window_of(View view, const RunData& run, std::span<const rendering::Object> objects) {
  Window window = bounds(view, objects);
  for (const RunRow& row : run.rows) {
    if (!row.located) {
      continue;
    }
    window.include(project(view, row.proxy_W));
  }
  scale_to_mm(window);
  const double margin = 0.05 * std::max({window.width(), window.height(), 1.0});
  window.lower = {.right = window.lower.right - margin, .up = window.lower.up - margin};
  window.upper = {.right = window.upper.right + margin, .up = window.upper.up + margin};
  return window;
}

// Lays out both panels with one scale. Their windows share the up axis, and either the width or the
// height of the sheet decides.
Sheet lay_out(const RunData& run, std::span<const rendering::Object> objects) {
  Sheet sheet;
  sheet.front = {.view = View::front, .window = window_of(View::front, run, objects)};
  sheet.side = {.view = View::side, .window = window_of(View::side, run, objects)};
  Window& front = sheet.front.window;
  Window& side = sheet.side.window;
  front.lower.up = side.lower.up = std::min(front.lower.up, side.lower.up);
  front.upper.up = side.upper.up = std::max(front.upper.up, side.upper.up);
  const double available = kSheetWidth - kLeft - kGap - kRight;
  const double pixels_per_mm =
      std::min(available / (front.width() + side.width()), kLargestPanelHeight / front.height());
  const double spare = available - pixels_per_mm * (front.width() + side.width());
  sheet.front.left = kLeft + 0.5 * spare;
  sheet.front.right = sheet.front.left + pixels_per_mm * front.width();
  sheet.side.left = sheet.front.right + kGap;
  sheet.side.right = sheet.side.left + pixels_per_mm * side.width();
  sheet.top = kPanelBottom + pixels_per_mm * front.height();
  sheet.height = std::ceil(sheet.top + kTitleHeight);
  return sheet;
}

// Returns two data blocks: the moves in contact with their force, and the free ones. A blank line
// lifts the pen, and each piece begins where the one before ended.
std::string path_blocks(const RunData& run, View view, std::string_view suffix) {
  std::string touching = fmt::format("$touching{} << EOD\n", suffix);
  std::string free = fmt::format("$free{} << EOD\n", suffix);
  bool was_contact = run.rows.front().contact;
  for (const std::size_t i : thin(run.rows, kMostPathPoints)) {
    const RunRow& row = run.rows[i];
    if (!row.located) {
      continue;
    }
    const PlanePoint point = project(view, row.proxy_W);
    const std::string line =
        fmt::format("{:.6g} {:.6g} {:.4g}\n", 1e3 * point.right, 1e3 * point.up, row.force_N);
    (was_contact ? touching : free) += line;
    if (row.contact != was_contact) {
      (was_contact ? touching : free) += "\n";
      (row.contact ? touching : free) += line;
      was_contact = row.contact;
    }
  }
  // Gnuplot complains about a block without points, so each has one that is never on the sheet.
  const std::string_view off_sheet = "\n1e9 1e9 0\nEOD\n";
  return touching.append(off_sheet) + free.append(off_sheet);
}

// Returns gnuplot's data block of the labels at the two ends of the drawn path.
std::string ends_block(const RunData& run, View view, const Window& window_mm,
                       std::string_view suffix) {
  // Ends that are closer than this share of the panel's width get one label; two would overlap.
  constexpr double kTogether = 0.08;
  const auto located = [](const RunRow& row) { return row.located; };
  const auto first = std::ranges::find_if(run.rows, located);
  const auto last = std::ranges::find_if(std::views::reverse(run.rows), located);
  std::string block = fmt::format("$ends{} << EOD\n1e9 1e9 \"\"\n", suffix);
  if (first != run.rows.end()) {
    const PlanePoint start = project(view, first->proxy_W);
    const PlanePoint end = project(view, last->proxy_W);
    const bool together = std::hypot(end.right - start.right, end.up - start.up) <
                          kTogether * window_mm.width() * 1e-3;
    const auto add = [&block](const PlanePoint& point, std::string_view label) {
      fmt::format_to(std::back_inserter(block), "{:.6g} {:.6g} \"{}\"\n", 1e3 * point.right,
                     1e3 * point.up, label);
    };
    add(start, together ? "start, end" : "start");
    add(end, together ? "" : "end");
  }
  return block + "EOD\n";
}

constexpr std::string_view kPathHead = R"gnuplot(
set border 3 linecolor "#555555"
set tics nomirror out textcolor "#333333"
unset key
set palette defined (0 "#3b5bb5", 0.35 "#8e3fa8", 0.65 "#dd3f4e", 0.85 "#f58a1f", 1 "#ffd23c")
set cbrange [0:{force:.4g}]
set label 1 {title} at screen {title_x:.5f},{title_y:.5f} left font ",18" textcolor "#111111" noenhanced
)gnuplot";

constexpr std::string_view kPanelScript = R"gnuplot(
set lmargin at screen {left:.6f}
set rmargin at screen {right:.6f}
set bmargin at screen {bottom:.6f}
set tmargin at screen {top:.6f}
set xrange [{x0:.6g}:{x1:.6g}]
set yrange [{y0:.6g}:{y1:.6g}]
set xlabel {xlabel} textcolor "#333333"
set ylabel {ylabel} textcolor "#333333" offset 0.5
{colour_box}
plot {image}, \
     $free{suffix} using 1:2 with lines linecolor "#4a4a4a" linewidth 1.2 dashtype (12,8), \
     $touching{suffix} using 1:2 with lines linecolor "#ffffff" linewidth 5.5, \
     $touching{suffix} using 1:2:3 with lines linecolor palette linewidth 3.2, \
     $ends{suffix} using 1:2 with points pointtype 7 pointsize 1.1 linecolor "#4a4a4a", \
     $ends{suffix} using 1:2:3 with labels left offset 1,0 textcolor "#4a4a4a"
unset label
)gnuplot";

// Returns the commands that draw a panel over its picture of the objects, which it writes into
// `folder`. The last panel has the colour bar.
std::string panel_script(const Sheet& sheet, const Panel& panel,
                         std::span<const rendering::Object> objects, const GnuplotFolder& folder,
                         bool last) {
  const Window& window = panel.window;
  const int columns = static_cast<int>(std::lround(panel.right - panel.left));
  const int rows = static_cast<int>(std::lround(sheet.top - kPanelBottom));
  Window window_m = window;
  for (PlanePoint* point : {&window_m.lower, &window_m.upper}) {
    point->right *= 1e-3;
    point->up *= 1e-3;
  }
  const std::filesystem::path image = folder.path() / (last ? "side.rgb" : "front.rgb");
  write_raw_rgb(image, draw_silhouette(panel.view, window_m, columns, rows, objects));
  const std::string colour_box =
      last ? fmt::format(
                 "set colorbox user origin {:.5f},{:.5f} size {:.5f},{:.5f} noborder\n"
                 "set cblabel 'rendered force (N)' textcolor '#333333' offset 0.8\nset cbtics "
                 "textcolor '#333333'",
                 (panel.right + 38.0) / kSheetWidth, kPanelBottom / sheet.height,
                 20.0 / kSheetWidth, (sheet.top - kPanelBottom) / sheet.height)
           : "unset colorbox";
  return fmt::format(
      kPanelScript, fmt::arg("left", panel.left / kSheetWidth),
      fmt::arg("right", panel.right / kSheetWidth), fmt::arg("bottom", kPanelBottom / sheet.height),
      fmt::arg("top", sheet.top / sheet.height), fmt::arg("x0", window.lower.right),
      fmt::arg("x1", window.upper.right), fmt::arg("y0", window.lower.up),
      fmt::arg("y1", window.upper.up),
      fmt::arg("xlabel", last ? "'z (mm), seen from the left; toward the user →'"
                              : "'x (mm), seen from the user'"),
      fmt::arg("ylabel", last ? "''" : "'y (mm)'"), fmt::arg("colour_box", colour_box),
      fmt::arg("image", rgb_item(image, columns, rows, window)),
      fmt::arg("suffix", last ? "_side" : "_front"));
}

}  // namespace

void draw_path_figure(const RunData& run, std::span<const rendering::Object> objects,
                      const std::string& title, const std::filesystem::path& picture) {
  const Sheet sheet = lay_out(run, objects);
  const double force_N = std::ranges::max_element(run.rows, {}, &RunRow::force_N)->force_N;
  const GnuplotFolder folder;
  std::string script = path_blocks(run, View::front, "_front") +
                       path_blocks(run, View::side, "_side") +
                       ends_block(run, View::front, sheet.front.window, "_front") +
                       ends_block(run, View::side, sheet.side.window, "_side");
  script += fmt::format(kPathHead, fmt::arg("force", std::max(force_N, 0.1)),
                        fmt::arg("title", gnuplot_string(title)),
                        fmt::arg("title_x", sheet.front.left / kSheetWidth),
                        fmt::arg("title_y", 1.0 - 0.5 * kTitleHeight / sheet.height));
  script += panel_script(sheet, sheet.front, objects, folder, false);
  script += panel_script(sheet, sheet.side, objects, folder, true);
  run_gnuplot(folder, {.width_px = kSheetWidth, .height_px = sheet.height}, script, picture);
}

}  // namespace tactus::host
