// Two panels and a legend below them, all in pixels.
#include "host_tools/graph/graph_picture.h"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <string>
#include <string_view>

#include "host_tools/graph/graph_layers.h"
#include "host_tools/graph/graph_view.h"
#include "host_tools/plot/gnuplot.h"

namespace tactus::host {
namespace {

constexpr int kGraphPanel = 860;
constexpr double kGraphWidth = 1800.0;
constexpr double kGraphHeight = 1040.0;
constexpr double kLegendHeight = 100.0;

constexpr std::string_view kGraphFrame = R"gnuplot(
unset border
unset tics
unset key
set lmargin at screen {left:.6f}
set rmargin at screen {right:.6f}
set bmargin at screen {bottom:.6f}
set tmargin at screen {top:.6f}
set xrange [0:{width}]
set yrange [0:{height}]
)gnuplot";

// Returns the commands that make pixels of the sheet the unit of what is drawn next.
std::string frame(double left, double bottom, double width, double height) {
  return fmt::format(kGraphFrame, fmt::arg("left", left / kGraphWidth),
                     fmt::arg("right", (left + width) / kGraphWidth),
                     fmt::arg("bottom", bottom / kGraphHeight),
                     fmt::arg("top", (bottom + height) / kGraphHeight), fmt::arg("width", width),
                     fmt::arg("height", height));
}

std::string panel_script(const GraphView& view, const GraphLayers& layers, bool is_right,
                         const GnuplotFolder& folder) {
  const std::string_view suffix = is_right ? "b" : "a";
  const std::filesystem::path image = folder.path() / fmt::format("graph_{}.rgb", suffix);
  write_raw_rgb(image, view.image());
  std::string blocks;
  std::string plots = fmt::format(
      "plot {} binary array=({},{}) format='%uchar%uchar%uchar' origin=(0.5,0.5) dx=1 dy=1 with "
      "rgbimage",
      gnuplot_string(image.string()), kGraphPanel, kGraphPanel);
  int number = 0;
  for (const GraphLayer& layer : layers.layers()) {
    if (!layer.rows.empty()) {
      const std::string name = fmt::format("$layer_{}{}", suffix, number++);
      fmt::format_to(std::back_inserter(blocks), "{} << EOD\n{}EOD\n", name, layer.rows);
      fmt::format_to(std::back_inserter(plots), ", \\\n  {} {}", name, layer.style);
    }
  }
  constexpr double kSide = 26.0;
  const double left = is_right ? kGraphWidth - kGraphPanel - kSide : kSide;
  return blocks + frame(left, kLegendHeight, kGraphPanel, kGraphPanel) + plots + "\n";
}

// A row of the legend, filled from the left.
class LegendRow {
 public:
  LegendRow(std::string title, double y) : y_(y) { add_text(title); }

  // Adds a short line or a mark in its style, and its text.
  void add(const GraphLayer& sample, const std::string& text) {
    constexpr double kSample = 34.0;
    const std::string name = fmt::format("$legend_{:.0f}_{:.0f}", y_, x_);
    const bool is_line = sample.style.find("with lines") != std::string::npos;
    blocks_ += is_line
                   ? fmt::format("{} << EOD\n{} {}\n{} {}\nEOD\n", name, x_, y_, x_ + kSample, y_)
                   : fmt::format("{} << EOD\n{} {}\nEOD\n", name, x_ + 0.6 * kSample, y_);
    fmt::format_to(std::back_inserter(plots_), ", {} {}", name, sample.style);
    x_ += kSample + 8.0;
    add_text(text);
  }

  void add_text(const std::string& text) {
    constexpr double kLegendLetter = 10.6;
    constexpr double kGap = 34.0;
    fmt::format_to(std::back_inserter(labels_),
                   "set label {} at first {},{} left textcolor \"#222222\" noenhanced\n",
                   gnuplot_string(text), x_, y_);
    x_ += kLegendLetter * static_cast<double>(text.size()) + kGap;
  }

  [[nodiscard]] const std::string& blocks() const { return blocks_; }
  [[nodiscard]] const std::string& labels() const { return labels_; }
  [[nodiscard]] const std::string& plots() const { return plots_; }

 private:
  double x_ = 40.0;
  double y_;
  std::string blocks_;
  std::string labels_;
  std::string plots_;
};

template <class Type, std::size_t Count>
std::array<std::size_t, Count> sum_of(const GraphSource& source,
                                      std::array<std::size_t, Count> GraphCounts::* member) {
  std::array<std::size_t, Count> sum{};
  for (const GraphedMesh& mesh : source.meshes) {
    const GraphCounts counts = count(mesh.graph);
    for (std::size_t i = 0; i < Count; ++i) {
      sum[i] += (counts.*member)[i];
    }
  }
  return sum;
}

std::string legend_script(const GraphSource& source, const GraphLayers& layers, double width) {
  LegendRow connections("Connections (E):", 68.0);
  const auto lines = sum_of<ConnectionType>(source, &GraphCounts::of_connections);
  for (std::size_t i = 0; i < kConnectionTypes; ++i) {
    const auto type = static_cast<ConnectionType>(i);
    if (lines[i] != 0) {
      connections.add({.style = line_style(type, 1.0), .rows = {}},
                      fmt::format("{} {}", lines[i], name_of(type)));
    }
  }
  LegendRow corners("Corners (V):", 32.0);
  const auto marks = sum_of<CornerType>(source, &GraphCounts::of_corners);
  for (std::size_t i = 0; i < kCornerTypes; ++i) {
    const auto type = static_cast<CornerType>(i);
    if (marks[i] != 0) {
      const std::string text = fmt::format("{} {}", marks[i], name_of(type));
      layers.has_nodes() ? corners.add({.style = mark_style(type), .rows = {}}, text)
                         : corners.add_text(text);
    }
  }
  if (layers.has_nodes()) {
    connections.add({.style = "with lines linecolor \"#5a5a5a\" linewidth 0.7", .rows = {}},
                    "nodes (F), at the faces, and their connections");
  }
  corners.add_text(source.is_scene
                       ? fmt::format("(a panel is {:.3g} mm wide)", 1e3 * width)
                       : fmt::format("(a panel is {:.3g} wide, in the file's unit)", width));
  return connections.blocks() + corners.blocks() + frame(0.0, 0.0, kGraphWidth, kLegendHeight) +
         connections.labels() + corners.labels() + "plot 1e9 notitle" + connections.plots() +
         corners.plots() + "\n";
}

}  // namespace

void draw_graph_picture(const GraphSource& source, const std::filesystem::path& picture) {
  const GnuplotFolder folder;
  std::string script;
  const GraphView front(source, GraphSide::front_right_above, kGraphPanel);
  const GraphLayers front_layers(source, front);
  std::size_t nodes = 0;
  for (const GraphedMesh& mesh : source.meshes) {
    nodes += mesh.graph.nodes.size();
  }
  script += panel_script(front, front_layers, false, folder);
  const GraphView behind(source, GraphSide::behind_left_below, kGraphPanel);
  script += panel_script(behind, GraphLayers(source, behind), true, folder);
  constexpr std::string_view kTitles =
      "set label 1 {} at screen 0.022,0.975 left font \",18\" textcolor \"#111111\" noenhanced\n"
      "set label 3 'from the front, right and above' at screen 0.022,0.94 left textcolor "
      "\"#555555\"\n"
      "set label 4 'from behind, left and below' at screen 0.508,0.94 left textcolor "
      "\"#555555\"\n";
  const std::string legend = legend_script(source, front_layers, front.width());
  script += fmt::format(
      kTitles,
      gnuplot_string(fmt::format("{}: connection graph of {} faces",
                                 std::filesystem::path(source.file).filename().string(), nodes)));
  script += legend;
  run_gnuplot(folder, {.width_px = kGraphWidth, .height_px = kGraphHeight}, script, picture);
}

}  // namespace tactus::host
