#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host_tools/plot/figures.h"
#include "host_tools/plot/gnuplot.h"

namespace tactus::host {
namespace {

// The sheet and a panel's picture, in pixels.
constexpr double kHolesWidth = 1800.0;
constexpr double kHolesHeight = 900.0;
constexpr int kHolesPixels = 800;

// One view: its square window in m, and whether it is the right panel.
struct HolesPanel {
  View view = View::front;
  Window window;
  bool is_right = false;
};

// Returns the square window about an object, with a margin.
Window square_about(View view, std::span<const rendering::Object> objects) {
  constexpr double kMargin = 0.55;
  const Window tight = bounds(view, objects);
  const double half = kMargin * std::max({tight.width(), tight.height(), 1e-6});
  const double right = 0.5 * (tight.lower.right + tight.upper.right);
  const double up = 0.5 * (tight.lower.up + tight.upper.up);
  return {.lower = {.right = right - half, .up = up - half},
          .upper = {.right = right + half, .up = up + half},
          .empty = false};
}

// Returns gnuplot's data blocks of the rims and of the rings about them, and the names in them.
std::string hole_blocks(std::span<const HoleMark> holes, const HolesPanel& panel,
                        std::string_view suffix) {
  // A small hole has a ring about it that can be seen.
  constexpr double kLeastRing = 0.015;
  std::string rims = fmt::format("$rims{} << EOD\n", suffix);
  std::string rings = fmt::format("$rings{} << EOD\n1e9 1e9 1 \"\"\n", suffix);
  int number = 0;
  for (const HoleMark& hole : holes) {
    for (const Vec3& p : hole.rim_W) {
      const PlanePoint point = project(panel.view, p);
      fmt::format_to(std::back_inserter(rims), "{:.7g} {:.7g}\n", 1e3 * point.right,
                     1e3 * point.up);
    }
    rims += "\n";
    const PlanePoint middle = project(panel.view, hole.middle_W);
    const double radius = std::max(0.7 * hole.size_m, kLeastRing * panel.window.width());
    fmt::format_to(std::back_inserter(rings), "{:.7g} {:.7g} {:.5g} \"{}\"\n", 1e3 * middle.right,
                   1e3 * middle.up, 1e3 * radius, ++number);
  }
  return rims + "1e9 1e9\nEOD\n" + rings + "EOD\n";
}

constexpr std::string_view kHolesPanel = R"gnuplot(
set border 3 linecolor "#555555"
set tics nomirror out textcolor "#333333"
unset key
set size ratio -1
set lmargin at screen {left:.5f}
set rmargin at screen {right:.5f}
set bmargin at screen 0.09
set tmargin at screen 0.92
set xrange [{x0:.7g}:{x1:.7g}]
set yrange [{y0:.7g}:{y1:.7g}]
set xlabel {xlabel} textcolor "#333333"
set ylabel 'y (mm)' textcolor "#333333"
plot {image}, \
     $rims{suffix} using 1:2 with lines linecolor "#dd3f4e" linewidth 3, \
     $rings{suffix} using 1:2:3 with circles linecolor "#dd3f4e" linewidth 1.2 fillstyle empty, \
     $rings{suffix} using ($1+$3):2:4 with labels left offset 0.6,0 textcolor "#dd3f4e"
unset label
)gnuplot";

std::string holes_panel(std::span<const rendering::Object> objects, std::span<const HoleMark> holes,
                        const HolesPanel& panel, const GnuplotFolder& folder) {
  const std::string_view suffix = panel.is_right ? "_right" : "_left";
  const std::filesystem::path image = folder.path() / fmt::format("holes{}.rgb", suffix);
  write_raw_rgb(image,
                draw_silhouette(panel.view, panel.window, kHolesPixels, kHolesPixels, objects));
  const Window& m = panel.window;
  const Window mm{.lower = {.right = 1e3 * m.lower.right, .up = 1e3 * m.lower.up},
                  .upper = {.right = 1e3 * m.upper.right, .up = 1e3 * m.upper.up},
                  .empty = false};
  const double left = panel.is_right ? 0.56 : 0.06;
  return hole_blocks(holes, panel, suffix) +
         fmt::format(
             kHolesPanel, fmt::arg("left", left), fmt::arg("right", left + 0.415),
             fmt::arg("x0", mm.lower.right), fmt::arg("x1", mm.upper.right),
             fmt::arg("y0", mm.lower.up), fmt::arg("y1", mm.upper.up),
             fmt::arg("xlabel", panel.is_right ? "'z (mm), seen from the left; toward the user →'"
                                               : "'x (mm), seen from the user'"),
             fmt::arg("image", rgb_item(image, kHolesPixels, kHolesPixels, mm)),
             fmt::arg("suffix", suffix));
}

}  // namespace

void draw_holes_figure(std::span<const rendering::Object> objects, std::span<const HoleMark> holes,
                       const std::string& title, const std::filesystem::path& picture) {
  const GnuplotFolder folder;
  std::string script;
  script += fmt::format(
      "set label 1 {} at screen 0.06,0.96 left font \",18\" textcolor \"#111111\" noenhanced\n",
      gnuplot_string(title));
  for (const View view : {View::front, View::side}) {
    script += holes_panel(
        objects, holes,
        {.view = view, .window = square_about(view, objects), .is_right = view == View::side},
        folder);
  }
  run_gnuplot(folder, {.width_px = kHolesWidth, .height_px = kHolesHeight}, script, picture);
}

}  // namespace tactus::host
