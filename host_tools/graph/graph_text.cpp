#include "host_tools/graph/graph_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string_view>

#include "host_tools/graph/graph_colours.h"

namespace tactus::host {
namespace {

// A mesh of many triangles makes much text, so it is appended piece by piece.
template <class... Values>
void append(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

double degrees(double rad) {
  return 180.0 / std::numbers::pi * rad;
}

// Returns "x, y, z" without the noise below a nanometre or a billionth.
std::string numbers_of(const Vec3& v) {
  constexpr double kNoise = 1e-12;
  const auto number = [](double x) { return std::abs(x) < kNoise ? 0.0 : x; };
  return fmt::format("{:.9g},{:.9g},{:.9g}", number(v.x()), number(v.y()), number(v.z()));
}

std::string rounded(const Vec3& v) {
  constexpr double kNoise = 1e-9;
  const auto number = [](double x) { return std::abs(x) < kNoise ? 0.0 : x; };
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", number(v.x()), number(v.y()), number(v.z()));
}

// Returns the numbers of the types that occur: "12 convex, 6 flat".
template <class Type, std::size_t Count>
std::string by_type(const std::array<std::size_t, Count>& counts) {
  std::string text;
  for (std::size_t i = 0; i < Count; ++i) {
    if (counts[i] != 0) {
      append(text, "{}{} {}", text.empty() ? "" : ", ", counts[i], name_of(static_cast<Type>(i)));
    }
  }
  return text;
}

// The first features of each kind; the others are counted.
constexpr std::size_t kListed = 6;

template <class Feature>
std::span<const Feature> first_of(const std::vector<Feature>& features) {
  return std::span(features).first(std::min(kListed, features.size()));
}

void append_features(std::string& text, const ConnectionGraph& graph) {
  std::size_t number = 0;
  for (const GraphNode& node : first_of(graph.nodes)) {
    append(text, "  node {:<8} corners {}, connections {}, flat face {}, normal {}\n", number++,
           fmt::join(node.corners, " "), fmt::join(node.connections, " "), node.flat_face,
           rounded(node.plane.normal));
  }
  number = 0;
  for (const Connection& connection : first_of(graph.connections)) {
    append(text, "  connection {:<2} from corner {} to {}, edge vector {}, node{}", number++,
           connection.corners[0], connection.corners[1], rounded(connection.edge_vector),
           connection.nodes.size() == 1 ? "" : "s");
    for (const ConnectedNode& side : connection.nodes) {
      append(text, " {}", side.node);
    }
    append(text, ", {}", name_of(connection.type));
    if (connection.type == ConnectionType::convex || connection.type == ConnectionType::concave) {
      append(text, ", {:.4g} degrees inside", degrees(connection.inner_angle));
    }
    text += '\n';
  }
  number = 0;
  for (const Corner& corner : first_of(graph.corners)) {
    append(text, "  corner {:<6} at {}, {}, connections {}\n", number++, rounded(corner.position),
           name_of(corner.type), fmt::join(corner.connections, " "));
  }
}

void append_summary(std::string& text, const GraphedMesh& mesh) {
  const GraphCounts counts = count(mesh.graph);
  append(text, "\n{}\n", mesh.name);
  append(text, "  nodes         {} in {} flat face{}\n", counts.nodes, mesh.graph.flat_faces,
         mesh.graph.flat_faces == 1 ? "" : "s");
  append(text, "  connections   {}: {}\n", counts.connections,
         by_type<ConnectionType>(counts.of_connections));
  append(text, "  corners       {}: {}\n", counts.corners, by_type<CornerType>(counts.of_corners));
  append(text, "  Euler         {} = {} corners - {} connections + {} nodes\n", counts.euler(),
         counts.corners, counts.connections, counts.nodes);
  append_features(text, mesh.graph);
  if (counts.connections > kListed) {
    append(text, "  ...           --json lists all, with their planes\n");
  }
}

std::string plane_json(const GraphPlane& plane) {
  return fmt::format(R"({{"normal":[{}],"offset":{:.9g}}})", numbers_of(plane.normal),
                     plane.offset);
}

std::string json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void append_nodes_json(std::string& text, const ConnectionGraph& graph) {
  std::string_view comma;
  for (const GraphNode& node : graph.nodes) {
    append(text, R"({}{{"plane":{},"corners":[{}],"connections":[{}],"flat_face":{}}})", comma,
           plane_json(node.plane), fmt::join(node.corners, ","), fmt::join(node.connections, ","),
           node.flat_face);
    comma = ",";
  }
}

void append_connections_json(std::string& text, const ConnectionGraph& graph) {
  std::string_view comma;
  for (const Connection& connection : graph.connections) {
    const bool has_angle = connection.type == ConnectionType::convex ||
                           connection.type == ConnectionType::concave ||
                           connection.type == ConnectionType::flat;
    append(text, R"({}{{"type":"{}","inner_angle_deg":{},"shared_vertices":[{}],)", comma,
           name_of(connection.type),
           has_angle ? fmt::format("{:.9g}", degrees(connection.inner_angle)) : "null",
           fmt::join(connection.corners, ","));
    append(text, R"("edge_vector":[{}],"connected_nodes":[)", numbers_of(connection.edge_vector));
    std::string_view side_comma;
    for (const ConnectedNode& side : connection.nodes) {
      append(text, R"({}{{"node":{},"edge":{},"voronoi_plane":{}}})", side_comma, side.node,
             side.edge, plane_json(side.voronoi));
      side_comma = ",";
    }
    append(text, R"(],"end_planes":[{},{}]}})", plane_json(connection.ends[0]),
           plane_json(connection.ends[1]));
    comma = ",";
  }
}

void append_corners_json(std::string& text, const ConnectionGraph& graph) {
  std::string_view comma;
  for (const Corner& corner : graph.corners) {
    append(text, R"({}{{"type":"{}","vertex":[{}],"connections":[{}]}})", comma,
           name_of(corner.type), numbers_of(corner.position), fmt::join(corner.connections, ","));
    comma = ",";
  }
}

void append_dot(std::string& text, const ConnectionGraph& graph, std::string_view prefix) {
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    append(text, "  {}f{} [label=\"F{}\", class=\"face\", shape=box, fillcolor=\"#ffffff\"];\n",
           prefix, i, i);
  }
  for (std::size_t i = 0; i < graph.connections.size(); ++i) {
    append(
        text,
        "  {}e{} [label=\"E{}\", class=\"edge\", shape=ellipse, fillcolor=\"{}\", fontcolor=white, "
        "tooltip=\"{}\"];\n",
        prefix, i, i, colour_of(graph.connections[i].type), name_of(graph.connections[i].type));
  }
  for (std::size_t i = 0; i < graph.corners.size(); ++i) {
    if (!graph.corners[i].connections.empty()) {
      append(text,
             "  {}v{} [label=\"V{}\", class=\"vertex\", shape=circle, color=\"{}\", penwidth=3, "
             "fillcolor=\"#ffffff\", tooltip=\"{}\"];\n",
             prefix, i, i, colour_of(graph.corners[i].type), name_of(graph.corners[i].type));
    }
  }
  for (std::size_t i = 0; i < graph.connections.size(); ++i) {
    const Connection& connection = graph.connections[i];
    for (const ConnectedNode& side : connection.nodes) {
      append(text, "  {}f{} -> {}e{};\n", prefix, side.node, prefix, i);
    }
    for (const std::uint32_t corner : connection.corners) {
      append(text, "  {}e{} -> {}v{};\n", prefix, i, prefix, corner);
    }
  }
}

}  // namespace

std::string graph_summary(const GraphSource& source) {
  std::string text =
      fmt::format("{}: {} mesh{}, lengths in {}\n", source.file, source.meshes.size(),
                  source.meshes.size() == 1 ? "" : "es", source.is_scene ? "m" : "the file's unit");
  for (const std::string& note : source.notes) {
    append(text, "note: {}\n", note);
  }
  for (const GraphedMesh& mesh : source.meshes) {
    append_summary(text, mesh);
  }
  return text;
}

std::string graph_json(const GraphSource& source) {
  std::string text = fmt::format(R"({{"file":{},"unit":{},"meshes":[)", json_string(source.file),
                                 source.is_scene ? "\"m\"" : "null");
  std::string_view comma;
  for (const GraphedMesh& mesh : source.meshes) {
    const GraphCounts counts = count(mesh.graph);
    append(text, R"({}{{"name":{},"object":{},"euler":{},"flat_faces":{},"nodes":[)", comma,
           json_string(mesh.name), mesh.object, counts.euler(), mesh.graph.flat_faces);
    append_nodes_json(text, mesh.graph);
    text += R"(],"connections":[)";
    append_connections_json(text, mesh.graph);
    text += R"(],"corners":[)";
    append_corners_json(text, mesh.graph);
    text += "]}";
    comma = ",";
  }
  return text + "]}\n";
}

std::string graph_dot(const GraphSource& source) {
  std::string text =
      "digraph connections {\n"
      "  graph [layout=neato, overlap=false, splines=true];\n"
      "  node [style=filled, fontname=\"sans-serif\", fontsize=11, margin=\"0.04,0.02\", "
      "width=0.3, "
      "height=0.3];\n"
      "  edge [color=\"#8a8a8a\", arrowsize=0.5];\n";
  for (std::size_t i = 0; i < source.meshes.size(); ++i) {
    append_dot(text, source.meshes[i].graph, i == 0 ? "" : fmt::format("m{}_", i));
  }
  return text + "}\n";
}

}  // namespace tactus::host
