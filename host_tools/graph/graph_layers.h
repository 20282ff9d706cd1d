// Sorts what a picture of connection graphs shows into layers for gnuplot: lines, marks and labels
// of one kind each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host_tools/graph/graph_source.h"
#include "host_tools/graph/graph_view.h"
#include "host_tools/graph/label_places.h"

namespace tactus::host {

// Return how gnuplot draws a connection and a corner, with its colour, dashes or shape. `scale` is
// 1, or less for fine meshes,
// in which dashes would be longer than the lines.
std::string line_style(ConnectionType type, double scale);
std::string mark_style(CornerType type);

// Points, lines or labels that are drawn in the same manner: rows of data, and the style that comes
// after them in gnuplot's command `plot`.
struct GraphLayer {
  std::string style;
  std::string rows;

  void add(const PlanePoint& p);
  void add(const PixelLine& line);
  void add(const PlanePoint& p, std::string_view label);
};

// Everything over one panel that the meshes do not hide.
class GraphLayers {
 public:
  GraphLayers(const GraphSource& source, const GraphView& view);

  // Returns the layers, the lowest first; some have no rows.
  [[nodiscard]] const std::vector<GraphLayer>& layers() const { return layers_; }
  // Return true if connections are long enough in the picture for nodes, and for numbers.
  [[nodiscard]] bool has_nodes() const;
  [[nodiscard]] bool has_numbers() const;

 private:
  void find_mean_length(const GraphSource& source);
  void set_styles();
  void add_lines(const ConnectionGraph& graph);
  void add_links(const ConnectionGraph& graph);
  void add_marks(const ConnectionGraph& graph);
  void add_nodes(const ConnectionGraph& graph);
  void add_numbers(const ConnectionGraph& graph);
  void add_label(GraphLayer& layer, const PlanePoint& p, const std::string& label);

  const GraphView& view_;
  // The mean length of the connections, in pixels.
  double mean_length_ = 0.0;
  LabelPlaces places_;
  std::vector<GraphLayer> layers_;
};

}  // namespace tactus::host
