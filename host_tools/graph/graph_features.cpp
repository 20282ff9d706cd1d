// The names of the types, their numbers, and the regions of features.
#include <algorithm>
#include <limits>

#include "host_tools/graph/connection_graph.h"

namespace tactus::host {

std::string_view name_of(ConnectionType type) {
  constexpr auto kConnectionNames = std::to_array<std::string_view>(
      {"convex", "concave", "flat", "open", "inconsistent", "non-manifold"});
  static_assert(kConnectionNames.size() == kConnectionTypes);
  return kConnectionNames[static_cast<std::size_t>(type)];
}

std::string_view name_of(CornerType type) {
  constexpr auto kCornerNames = std::to_array<std::string_view>(
      {"convex", "concave", "partly convex", "flat", "border", "irregular"});
  static_assert(kCornerNames.size() == kCornerTypes);
  return kCornerNames[static_cast<std::size_t>(type)];
}

GraphCounts count(const ConnectionGraph& graph) {
  GraphCounts counts{.nodes = graph.nodes.size(), .connections = graph.connections.size()};
  for (const Connection& connection : graph.connections) {
    ++counts.of_connections[static_cast<std::size_t>(connection.type)];
  }
  for (const Corner& corner : graph.corners) {
    if (!corner.connections.empty()) {
      ++counts.corners;
      ++counts.of_corners[static_cast<std::size_t>(corner.type)];
    }
  }
  return counts;
}

double beyond_face(const ConnectionGraph& graph, std::uint32_t node, const Vec3& p) {
  double most = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t number : graph.nodes[node].connections) {
    for (const ConnectedNode& side : graph.connections[number].nodes) {
      if (side.node == node) {
        most = std::max(most, side.voronoi.height(p));
      }
    }
  }
  return most;
}

double beyond_edge(const ConnectionGraph& graph, std::uint32_t connection, const Vec3& p) {
  const Connection& edge = graph.connections[connection];
  double most = std::max(edge.ends[0].height(p), edge.ends[1].height(p));
  for (const ConnectedNode& side : edge.nodes) {
    most = std::max(most, -side.voronoi.height(p));
  }
  return most;
}

double beyond_vertex(const ConnectionGraph& graph, std::uint32_t corner, const Vec3& p) {
  double most = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t number : graph.corners[corner].connections) {
    const Connection& edge = graph.connections[number];
    most = std::max(most, -edge.ends[edge.corners[0] == corner ? 0 : 1].height(p));
  }
  return most;
}

}  // namespace tactus::host
