#include "host_tools/graph/graph_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "host_tools/graph/graph_colours.h"

namespace tactus::host {
namespace {

// Connections of this length in pixels, on average, leave room for numbers, and for nodes.
constexpr double kRoomForNumbers = 70.0;
constexpr double kRoomForNodes = 30.0;
// The size of a letter of a label.
constexpr double kLetterWidth = 8.0;
constexpr double kLetterHeight = 15.0;
constexpr double kLabelRim = 5.0;

// The layers in the order in which they are drawn. Flat connections lie under the others.
enum LayerNumber : std::size_t {
  kLinks,
  kFlatLines,
  kLines,
  kSmallNodes = kLines + kConnectionTypes,
  kNodeBoxes,
  kNodeFrames,
  kNodeLabels,
  kMarks,
  kLineLabels = kMarks + kCornerTypes,
  kMarkLabels = kLineLabels + kConnectionTypes,
  kGraphLayers,
};

std::size_t line_layer(ConnectionType type) {
  return type == ConnectionType::flat ? kFlatLines : kLines + static_cast<std::size_t>(type);
}

const Vec3& position(const ConnectionGraph& graph, const Connection& connection, std::size_t end) {
  return graph.corners[connection.corners[end]].position;
}

Vec3 centre(const ConnectionGraph& graph, const GraphNode& node) {
  return (graph.corners[node.corners[0]].position + graph.corners[node.corners[1]].position +
          graph.corners[node.corners[2]].position) /
         3.0;
}

}  // namespace

std::string line_style(ConnectionType type, double scale) {
  const bool is_flat = type == ConnectionType::flat;
  return fmt::format("with lines linecolor \"{}\" linewidth {:.3g} dashtype {}", colour_of(type),
                     (is_flat ? 0.8 : 2.4) * scale, is_flat && scale == 1.0 ? 2 : 1);
}

std::string mark_style(CornerType type) {
  // Disc, triangle downwards, diamond, small disc, square, cross.
  constexpr std::array<int, kCornerTypes> kShapes = {7, 11, 13, 7, 5, 2};
  constexpr std::array<double, kCornerTypes> kSizes = {1.5, 1.7, 2.0, 0.7, 1.3, 1.6};
  const auto i = static_cast<std::size_t>(type);
  return fmt::format("with points linecolor \"{}\" pointtype {} pointsize {:.3g} linewidth 2",
                     colour_of(type), kShapes[i], kSizes[i]);
}

void GraphLayer::add(const PlanePoint& p) {
  fmt::format_to(std::back_inserter(rows), "{:.5g} {:.5g}\n", p.right, p.up);
}

void GraphLayer::add(const PixelLine& line) {
  add(line.first);
  add(line.second);
  rows += '\n';
}

void GraphLayer::add(const PlanePoint& p, std::string_view label) {
  fmt::format_to(std::back_inserter(rows), "{:.5g} {:.5g} \"{}\"\n", p.right, p.up, label);
}

GraphLayers::GraphLayers(const GraphSource& source, const GraphView& view)
    : view_(view), layers_(kGraphLayers) {
  find_mean_length(source);
  set_styles();
  const auto add = [&](auto part) {
    for (const GraphedMesh& mesh : source.meshes) {
      (this->*part)(mesh.graph);
    }
  };
  add(&GraphLayers::add_lines);
  if (has_nodes()) {
    add(&GraphLayers::add_links);
    add(&GraphLayers::add_marks);
    add(&GraphLayers::add_nodes);
  }
  if (has_numbers()) {
    add(&GraphLayers::add_numbers);
  }
}

bool GraphLayers::has_nodes() const {
  return mean_length_ >= kRoomForNodes;
}

bool GraphLayers::has_numbers() const {
  return mean_length_ >= kRoomForNumbers;
}

void GraphLayers::find_mean_length(const GraphSource& source) {
  double sum = 0.0;
  double number = 0.0;
  for (const GraphedMesh& mesh : source.meshes) {
    for (const Connection& connection : mesh.graph.connections) {
      const PlanePoint a = view_.pixel_of(position(mesh.graph, connection, 0));
      const PlanePoint b = view_.pixel_of(position(mesh.graph, connection, 1));
      sum += std::hypot(b.right - a.right, b.up - a.up);
      number += 1.0;
    }
  }
  mean_length_ = sum / std::max(number, 1.0);
}

void GraphLayers::set_styles() {
  // Lines get thinner below this length, so that the mesh can be seen between them.
  constexpr double kFullWidth = 20.0;
  constexpr double kLeastWidth = 0.35;
  const double scale = std::clamp(mean_length_ / kFullWidth, kLeastWidth, 1.0);
  layers_[kLinks].style = R"(with lines linecolor "#5a5a5a" linewidth 0.7)";
  layers_[kSmallNodes].style = R"(with points linecolor "#333333" pointtype 5 pointsize 0.6)";
  layers_[kNodeBoxes].style =
      R"(using 1:2:3:4 with boxxyerror linecolor "#ffffff" fillstyle solid noborder)";
  layers_[kNodeFrames].style =
      R"(using 1:2:3:4 with boxxyerror linecolor "#333333" linewidth 0.8 fillstyle empty)";
  layers_[kNodeLabels].style = R"(with labels font ",10" textcolor "#111111")";
  layers_[kMarkLabels].style = R"(with labels font ",11" textcolor "#000000")";
  for (std::size_t i = 0; i < kConnectionTypes; ++i) {
    const auto type = static_cast<ConnectionType>(i);
    layers_[line_layer(type)].style = line_style(type, scale);
    layers_[kLineLabels + i].style =
        fmt::format(R"(with labels font ",10" textcolor "{}")", colour_of(type));
  }
  for (std::size_t i = 0; i < kCornerTypes; ++i) {
    layers_[kMarks + i].style = mark_style(static_cast<CornerType>(i));
  }
}

void GraphLayers::add_lines(const ConnectionGraph& graph) {
  for (const Connection& connection : graph.connections) {
    for (const PixelLine& part :
         view_.visible_parts(position(graph, connection, 0), position(graph, connection, 1))) {
      layers_[line_layer(connection.type)].add(part);
      if (has_numbers()) {
        places_.keep_off(part);
      }
    }
  }
}

// A link runs from a connection's middle to the centre of each of its nodes.
void GraphLayers::add_links(const ConnectionGraph& graph) {
  for (const Connection& connection : graph.connections) {
    const Vec3 middle = position(graph, connection, 0) + 0.5 * connection.edge_vector;
    for (const ConnectedNode& side : connection.nodes) {
      for (const PixelLine& part :
           view_.visible_parts(middle, centre(graph, graph.nodes[side.node]))) {
        layers_[kLinks].add(part);
        places_.keep_off(part);
      }
    }
  }
}

void GraphLayers::add_marks(const ConnectionGraph& graph) {
  constexpr double kMark = 14.0;
  for (const Corner& corner : graph.corners) {
    if (!corner.connections.empty() && !view_.hides(corner.position)) {
      const PlanePoint p = view_.pixel_of(corner.position);
      layers_[kMarks + static_cast<std::size_t>(corner.type)].add(p);
      places_.take({.middle = p, .width = kMark, .height = kMark});
    }
  }
}

// A node is a box with its number where there is room, and a small square elsewhere.
void GraphLayers::add_nodes(const ConnectionGraph& graph) {
  constexpr double kSmall = 8.0;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const Vec3 middle = centre(graph, graph.nodes[i]);
    if (view_.hides(middle)) {
      continue;
    }
    const PlanePoint p = view_.pixel_of(middle);
    const std::string label = fmt::format("F{}", i);
    const LabelBox box{.middle = p,
                       .width = kLetterWidth * static_cast<double>(label.size()) + kLabelRim,
                       .height = kLetterHeight + kLabelRim};
    const LabelBox small{.middle = p, .width = kSmall, .height = kSmall};
    if (has_numbers() && places_.is_free_of_labels(box)) {
      places_.take(box);
      for (const LayerNumber layer : {kNodeBoxes, kNodeFrames}) {
        fmt::format_to(std::back_inserter(layers_[layer].rows), "{:.5g} {:.5g} {:.5g} {:.5g}\n",
                       p.right, p.up, 0.5 * box.width, 0.5 * box.height);
      }
      layers_[kNodeLabels].add(p, label);
    } else if (places_.is_free_of_labels(small)) {
      places_.take(small);
      layers_[kSmallNodes].add(p);
    }
  }
}

void GraphLayers::add_numbers(const ConnectionGraph& graph) {
  for (std::size_t i = 0; i < graph.corners.size(); ++i) {
    const Corner& corner = graph.corners[i];
    if (!corner.connections.empty() && !view_.hides(corner.position)) {
      add_label(layers_[kMarkLabels], view_.pixel_of(corner.position), fmt::format("V{}", i));
    }
  }
  for (std::size_t i = 0; i < graph.connections.size(); ++i) {
    // The number stands beside the link, which is in the middle.
    constexpr double kAlong = 0.36;
    const Connection& connection = graph.connections[i];
    const Vec3 p = position(graph, connection, 0) + kAlong * connection.edge_vector;
    if (!view_.hides(p)) {
      add_label(layers_[kLineLabels + static_cast<std::size_t>(connection.type)], view_.pixel_of(p),
                fmt::format("E{}", i));
    }
  }
}

void GraphLayers::add_label(GraphLayer& layer, const PlanePoint& p, const std::string& label) {
  const double width = kLetterWidth * static_cast<double>(label.size()) + kLabelRim;
  if (const auto middle = places_.take_beside(p, width, kLetterHeight)) {
    layer.add(*middle, label);
  }
}

}  // namespace tactus::host
