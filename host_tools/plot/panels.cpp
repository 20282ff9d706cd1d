#include "host_tools/plot/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "host_tools/plot/gnuplot.h"

namespace tactus::host {
namespace {

constexpr double kPanelsWidth = 1200;
constexpr double kLonePanelHeight = 800;
constexpr double kPanelHeight = 430;

// Colours that differ in brightness too, for people who see few colours.
constexpr std::array<std::string_view, 5> kColours{"#17406d", "#d0421b", "#4c9a78", "#8e6bb3",
                                                   "#b8860b"};

// Returns the indices of the first, the lowest and the highest point of each of about 3000
// stretches, and of the last point: more than the pixels show.
std::vector<std::size_t> thinned_curve(const Curve& curve) {
  constexpr std::size_t kStretches = 3000;
  const std::size_t size = curve.x.size();
  const std::size_t length = std::max<std::size_t>(1, size / kStretches);
  std::vector<std::size_t> kept;
  auto keep = [&kept, next = std::size_t{0}](std::size_t i) mutable {
    if (i >= next) {
      kept.push_back(i);
      next = i + 1;
    }
  };
  for (std::size_t from = 0; from < size; from += length) {
    std::size_t low = from;
    std::size_t high = from;
    for (std::size_t i = from; i < std::min(size, from + length); ++i) {
      low = curve.y[i] < curve.y[low] ? i : low;
      high = curve.y[i] > curve.y[high] ? i : high;
    }
    keep(from);
    keep(std::min(low, high));
    keep(std::max(low, high));
  }
  if (size > 0) {
    keep(size - 1);
  }
  return kept;
}

std::string curve_block(std::string_view name, const Curve& curve) {
  std::string block = fmt::format("{} << EOD\n", name);
  for (const std::size_t i : thinned_curve(curve)) {
    fmt::format_to(std::back_inserter(block), "{:.7g} {:.7g}\n", curve.x[i], curve.y[i]);
  }
  return block + "EOD\n";
}

std::string style_of(const Curve& curve, std::string_view colour) {
  switch (curve.style) {
    case CurveStyle::dashes:
      return fmt::format("with lines dashtype 2 linewidth 1.5 linecolor \"{}\"", colour);
    case CurveStyle::points:
      return fmt::format("with points pointtype 7 pointsize 0.4 linecolor \"{}\"", colour);
    case CurveStyle::faint_points:
      return "with points pointtype 7 pointsize 0.5 linecolor \"#9fb7d1\"";
    case CurveStyle::line_with_points:
      return fmt::format(
          "with linespoints pointtype 7 pointsize 1.3 linewidth 1.7 linecolor \"{}\"", colour);
    default:
      return fmt::format("with lines linewidth 1.7 linecolor \"{}\"", colour);
  }
}

constexpr std::string_view kPanelsHead = R"gnuplot(
set border 3 linecolor "#555555"
set tics nomirror out textcolor "#333333"
set grid linecolor "#e3e3e3" linewidth 0.7 linetype 1
set lmargin at screen 0.105
set rmargin at screen 0.97
set offsets graph 0.02, graph 0.02, graph 0.06, graph 0.06
set autoscale noextend
set label 1 {title} at screen 0.105,{title_height:.4g} left font ",18" textcolor "#111111" noenhanced
)gnuplot";

// Returns the script of one panel. `top` and `bottom` are shares of the picture's height, from
// below. The key stands above the panel.
std::string panel_script(const Panel& panel, std::size_t index, double top, double bottom) {
  constexpr std::string_view kPanel = R"gnuplot(
set tmargin at screen {top:.4g}
set bmargin at screen {bottom:.4g}
set key at screen 0.97,{top:.4g} right bottom horizontal textcolor "#333333" samplen 2.2 width 1 noenhanced
set xlabel {x_label} textcolor "#333333" noenhanced
set ylabel {y_label} textcolor "#333333" offset 0.5 noenhanced
plot )gnuplot";
  std::string script = fmt::format(kPanel, fmt::arg("top", top), fmt::arg("bottom", bottom),
                                   fmt::arg("x_label", gnuplot_string(panel.x_label)),
                                   fmt::arg("y_label", gnuplot_string(panel.y_label)));
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const Curve& curve = panel.curves[i];
    const std::string title = curve.name.empty()
                                  ? std::string("notitle")
                                  : fmt::format("title {}", gnuplot_string(curve.name));
    script += fmt::format("{}$curve_{}_{} using 1:2 {} {}", i == 0 ? "" : ", ", index, i,
                          style_of(curve, kColours.at(i % kColours.size())), title);
  }
  return script + "\nunset label 1\n";
}

}  // namespace

void draw_panels(const std::string& title, std::span<const Panel> panels,
                 const std::filesystem::path& picture) {
  // Heights in pixels: of the title, and around each panel.
  constexpr double kTitle = 50;
  constexpr double kAbovePanel = 35;
  constexpr double kBelowPanel = 80;
  const auto count = static_cast<double>(panels.size());
  const double height = panels.size() == 1 ? kLonePanelHeight : kTitle + count * kPanelHeight;
  std::string script;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    for (std::size_t i = 0; i < panels[p].curves.size(); ++i) {
      script += curve_block(fmt::format("$curve_{}_{}", p, i), panels[p].curves[i]);
    }
  }
  const GnuplotFolder folder;
  script += fmt::format(kPanelsHead, fmt::arg("title", gnuplot_string(title)),
                        fmt::arg("title_height", 1.0 - 0.5 * kTitle / height));
  const double each = (height - kTitle) / count;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const double top = kTitle + static_cast<double>(p) * each + kAbovePanel;
    const double bottom = kTitle + static_cast<double>(p + 1) * each - kBelowPanel;
    script += panel_script(panels[p], p, 1.0 - top / height, 1.0 - bottom / height);
  }
  run_gnuplot(folder, {.width_px = kPanelsWidth, .height_px = height}, script, picture);
}

}  // namespace tactus::host
