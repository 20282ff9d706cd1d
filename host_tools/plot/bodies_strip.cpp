#include "host_tools/plot/bodies_strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "host_tools/plot/gnuplot.h"
#include "host_tools/plot/silhouette.h"

namespace tactus::host {
namespace {

// The sheet in pixels: a title, two rows of panels, axes at the left and below.
constexpr double kBodiesWidth = 1800.0;
constexpr double kBodiesLeft = 95.0;
constexpr double kBodiesRight = 20.0;
constexpr double kBodiesTop = 105.0;
constexpr double kBodiesBottom = 95.0;
constexpr double kBodiesGap = 14.0;
// The length of the largest force's arrow, as a share of a panel's width.
constexpr double kBodiesArrow = 0.2;
// The length of a body's axes.
constexpr double kBodiesAxis = 0.08;

// The extent of all panels, mm. Both views share width and height, so that the scale is one.
struct BodiesExtent {
  PlanePoint front;  // the middle of the front view
  PlanePoint side;
  double width = 0.0;
  double height = 0.0;
};

// Returns the world position of a vertex that is given where the first frame has the body.
Vec3 moved(const rendering::Float3& vertex, const BodyPlace& first, const BodyPlace& now) {
  const Vec3 in_body = first.axes_W.transpose() * (rendering::to_vec3(vertex) - first.center_W);
  return now.center_W + now.axes_W * in_body;
}

// A frame with its objects, and the memory of the bodies' moved meshes.
struct PosedFrame {
  // Points into the strip.
  const BodiesFrame* frame = nullptr;
  std::vector<std::vector<rendering::Float3>> vertices;
  std::vector<rendering::Object> objects;
};

PosedFrame posed(const BodiesStrip& strip, const BodiesFrame& frame) {
  PosedFrame result{
      .frame = &frame, .vertices = {}, .objects = {strip.objects.begin(), strip.objects.end()}};
  std::size_t body = 0;
  for (rendering::Object& object : result.objects) {
    if (!is_body(object)) {
      continue;
    }
    const BodyPlace& first = strip.frames.front().bodies[body];
    const BodyPlace& now = frame.bodies[body++];
    std::vector<rendering::Float3>& own = result.vertices.emplace_back();
    own.reserve(object.mesh.vertices.size());
    for (const rendering::Float3& vertex : object.mesh.vertices) {
      own.push_back(rendering::to_float3(moved(vertex, first, now)));
    }
    object.mesh.vertices = own;
  }
  return result;
}

// Returns the row of a tool's run at a time, or the last one.
const RunRow& row_at(const RunData& run, double t_s) {
  const auto row = std::ranges::lower_bound(run.rows, t_s, {}, &RunRow::t_s);
  return row == run.rows.end() ? run.rows.back() : *row;
}

// Adds the bodies and tools of a frame to a window, m.
void include(const BodiesStrip& strip, const PosedFrame& now, View view, Window& window) {
  for (const std::vector<rendering::Float3>& body : now.vertices) {
    for (const rendering::Float3& vertex : body) {
      window.include(project(view, rendering::to_vec3(vertex)));
    }
  }
  for (const RunData& run : strip.tools) {
    const RunRow& row = row_at(run, now.frame->t_s);
    if (row.located) {
      const PlanePoint at = project(view, row.proxy_W);
      window.include({.right = at.right - strip.tool_radius_m, .up = at.up - strip.tool_radius_m});
      window.include({.right = at.right + strip.tool_radius_m, .up = at.up + strip.tool_radius_m});
    }
  }
}

// Returns the frames that are drawn.
std::vector<PosedFrame> chosen(const BodiesStrip& strip) {
  std::vector<PosedFrame> frames;
  frames.reserve(strip.columns);
  for (std::size_t i = 0; i < strip.columns; ++i) {
    frames.push_back(
        posed(strip, strip.frames[i * (strip.frames.size() - 1) / (strip.columns - 1)]));
  }
  return frames;
}

// Returns an extent that holds everything that moves in the chosen frames, with a margin.
BodiesExtent extent_of(const BodiesStrip& strip, std::span<const PosedFrame> frames) {
  Window front;
  Window side;
  for (const PosedFrame& frame : frames) {
    include(strip, frame, View::front, front);
    include(strip, frame, View::side, side);
  }
  constexpr double kMargin = 1.2;
  const double up =
      0.5e3 * (std::min(front.lower.up, side.lower.up) + std::max(front.upper.up, side.upper.up));
  const auto right = [](const Window& window) {
    return 0.5e3 * (window.lower.right + window.upper.right);
  };
  const double width = kMargin * 1e3 * std::max(front.width(), side.width());
  const double height = kMargin * 1e3 * std::max(front.height(), side.height());
  // No panel is more than twice as high as wide, or half as high.
  return {.front = {.right = right(front), .up = up},
          .side = {.right = right(side), .up = up},
          .width = std::max({width, 0.5 * height, 1.0}),
          .height = std::max({height, 0.5 * width, 1.0})};
}

// Returns the commands for the axes of the bodies, x red, y green and z blue, so that their turning
// shows.
std::string axes_script(const BodiesFrame& frame, View view, double length_mm) {
  constexpr std::array<std::string_view, 3> kColours = {"#c0392b", "#2e8b57", "#2c5aa0"};
  std::string script;
  for (const BodyPlace& body : frame.bodies) {
    const PlanePoint at = project(view, body.center_W);
    for (std::size_t axis = 0; axis < kColours.size(); ++axis) {
      const PlanePoint along = project(view, body.axes_W.col(static_cast<Eigen::Index>(axis)));
      fmt::format_to(std::back_inserter(script),
                     "set arrow from {:.6g},{:.6g} rto {:.6g},{:.6g} nohead lw 1.6 lc rgb '{}' "
                     "front\n",
                     1e3 * at.right, 1e3 * at.up, length_mm * along.right, length_mm * along.up,
                     kColours.at(axis));
    }
  }
  return script;
}

constexpr std::string_view kBodiesPanel = R"gnuplot(
set lmargin at screen {left:.6f}
set rmargin at screen {right:.6f}
set bmargin at screen {bottom:.6f}
set tmargin at screen {top:.6f}
set xrange [{x0:.6g}:{x1:.6g}]
set yrange [{y0:.6g}:{y1:.6g}]
set xlabel {xlabel} textcolor "#333333"
set ylabel {ylabel} textcolor "#333333" offset 0.5
set xtics {step:.6g}
set ytics {step:.6g}
set format x {xformat}
set format y {yformat}
{time}
{tools}
plot {image}
unset label
unset object
unset arrow
)gnuplot";

// The place of a panel on the sheet, in pixels, and what it shows.
struct BodiesPanel {
  View view = View::front;
  std::size_t column = 0;
  double left = 0.0;
  double bottom = 0.0;
  double width = 0.0;
  double height = 0.0;
  double sheet_height = 0.0;
  // The length of the arrow of one newton, mm.
  double mm_per_N = 0.0;
};

// Returns the commands for the tools of a frame: a circle each, and the force on the hand.
std::string tools_script(const BodiesStrip& strip, const BodiesFrame& frame,
                         const BodiesPanel& panel) {
  std::string script;
  for (const RunData& run : strip.tools) {
    const RunRow& row = row_at(run, frame.t_s);
    if (!row.located) {
      continue;
    }
    const PlanePoint at = project(panel.view, row.proxy_W);
    const PlanePoint force = project(panel.view, row.force_W);
    fmt::format_to(std::back_inserter(script),
                   "set object circle at {0:.6g},{1:.6g} size {2:.6g} fillstyle solid 0.25 border "
                   "lc rgb '#3b5bb5' fillcolor rgb '#3b5bb5' front\n",
                   1e3 * at.right, 1e3 * at.up, 1e3 * std::max(strip.tool_radius_m, 1e-4));
    if (row.force_N > 0.0) {
      fmt::format_to(std::back_inserter(script),
                     "set arrow from {:.6g},{:.6g} rto {:.6g},{:.6g} lw 2.5 lc rgb '#dd3f4e' "
                     "head filled size screen 0.006,18 front\n",
                     1e3 * at.right, 1e3 * at.up, panel.mm_per_N * force.right,
                     panel.mm_per_N * force.up);
    }
  }
  return script;
}

// Returns the commands of a panel, whose picture of the objects it writes into the folder.
std::string strip_panel(const BodiesStrip& strip, const PosedFrame& now, const BodiesExtent& extent,
                        const BodiesPanel& panel, const GnuplotFolder& folder) {
  const BodiesFrame& frame = *now.frame;
  const bool is_front = panel.view == View::front;
  const PlanePoint& middle = is_front ? extent.front : extent.side;
  const Window mm{
      .lower = {.right = middle.right - 0.5 * extent.width, .up = middle.up - 0.5 * extent.height},
      .upper = {.right = middle.right + 0.5 * extent.width, .up = middle.up + 0.5 * extent.height},
      .empty = false};
  const Window window_m{.lower = {.right = 1e-3 * mm.lower.right, .up = 1e-3 * mm.lower.up},
                        .upper = {.right = 1e-3 * mm.upper.right, .up = 1e-3 * mm.upper.up},
                        .empty = false};
  const int columns = static_cast<int>(std::lround(panel.width));
  const int rows = static_cast<int>(std::lround(panel.height));
  const std::filesystem::path image =
      folder.path() / fmt::format("{}{}.rgb", is_front ? "front" : "side", panel.column);
  write_raw_rgb(image, draw_silhouette(panel.view, window_m, columns, rows, now.objects));
  const bool is_first = panel.column == 0;
  const std::string time =
      is_front
          ? fmt::format("set label 2 '{:.2f} s' at screen {:.6f},{:.6f} center textcolor '#111111'",
                        frame.t_s, (panel.left + 0.5 * panel.width) / kBodiesWidth,
                        (panel.bottom + panel.height + 18.0) / panel.sheet_height)
          : "";
  return fmt::format(kBodiesPanel, fmt::arg("left", panel.left / kBodiesWidth),
                     fmt::arg("right", (panel.left + panel.width) / kBodiesWidth),
                     fmt::arg("bottom", panel.bottom / panel.sheet_height),
                     fmt::arg("top", (panel.bottom + panel.height) / panel.sheet_height),
                     fmt::arg("x0", mm.lower.right), fmt::arg("x1", mm.upper.right),
                     fmt::arg("y0", mm.lower.up), fmt::arg("y1", mm.upper.up),
                     fmt::arg("step", round_step(extent.width / 5.0)),
                     fmt::arg("xlabel", !is_first  ? "''"
                                        : is_front ? "'x (mm)'"
                                                   : "'z (mm), from the left'"),
                     fmt::arg("ylabel", is_first ? "'y (mm)'" : "''"),
                     fmt::arg("xformat", is_first ? "'%g'" : "''"),
                     fmt::arg("yformat", is_first ? "'%g'" : "''"), fmt::arg("time", time),
                     fmt::arg("tools", axes_script(frame, panel.view, kBodiesAxis * extent.width) +
                                           tools_script(strip, frame, panel)),
                     fmt::arg("image", rgb_item(image, columns, rows, mm)));
}

}  // namespace

void draw_bodies_strip(const BodiesStrip& strip, const std::filesystem::path& picture) {
  const std::vector<PosedFrame> frames = chosen(strip);
  const BodiesExtent extent = extent_of(strip, frames);
  const auto count = static_cast<double>(strip.columns);
  BodiesPanel panel;
  panel.width = (kBodiesWidth - kBodiesLeft - kBodiesRight - (count - 1.0) * kBodiesGap) / count;
  panel.height = panel.width * extent.height / extent.width;
  panel.sheet_height = std::ceil(kBodiesTop + 2.0 * (panel.height + kBodiesBottom));
  double most_N = 0.0;
  for (const PosedFrame& now : frames) {
    for (const RunData& run : strip.tools) {
      most_N = std::max(most_N, row_at(run, now.frame->t_s).force_N);
    }
  }
  panel.mm_per_N = most_N > 0.0 ? kBodiesArrow * extent.width / most_N : 0.0;
  const GnuplotFolder folder;
  std::string script = fmt::format(
      "set border 15 linecolor '#999999'\nset tics out nomirror textcolor '#333333'\nunset key\n"
      "set label 1 {} at screen {:.5f},{:.5f} left font ',18' textcolor '#111111' noenhanced\n",
      gnuplot_string(strip.title), kBodiesLeft / kBodiesWidth, 1.0 - 32.0 / panel.sheet_height);
  for (const View view : {View::front, View::side}) {
    panel.view = view;
    panel.bottom = kBodiesBottom + (view == View::front ? panel.height + kBodiesBottom : 0.0);
    for (panel.column = 0; panel.column < strip.columns; ++panel.column) {
      panel.left = kBodiesLeft + static_cast<double>(panel.column) * (panel.width + kBodiesGap);
      script += strip_panel(strip, frames[panel.column], extent, panel, folder);
    }
  }
  run_gnuplot(folder, {.width_px = kBodiesWidth, .height_px = panel.sheet_height}, script, picture);
}

}  // namespace tactus::host
