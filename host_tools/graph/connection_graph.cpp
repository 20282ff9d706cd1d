#include "host_tools/graph/connection_graph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

namespace tactus::host {
namespace {

using rendering::Float3;
using rendering::to_vec3;
using rendering::TriangleIndices;

// A sine below this is flat: a step of a micrometre in 10 mm, about the contact margin.
constexpr double kFlatSine = 1e-4;
// The part of the largest coordinate by which rounding to float may lift the third vertex of a face
// off the plane of the other one: all four vertices are rounded by half a unit in the last place.
constexpr double kRounding = 4.0 * static_cast<double>(std::numeric_limits<float>::epsilon());

constexpr std::uint32_t next_corner(std::uint32_t k) {
  return (k + 1U) % 3U;
}

// Numbers that are joined into groups.
class Groups {
 public:
  explicit Groups(std::size_t count) {
    parent_.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      parent_.push_back(i);
    }
  }

  std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  // The smaller number stands for the group.
  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({of(a), of(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// One side of an edge, sorted by the edge's vertices.
struct Side {
  std::uint64_t key = 0;
  std::uint32_t node = 0;
  std::uint32_t edge = 0;
};

std::vector<Side> sides_of(std::span<const TriangleIndices> triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][k], triangles[t][next_corner(k)]);
      sides.push_back({.key = (std::uint64_t{low} << 32U) | high, .node = t, .edge = k});
    }
  }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.key, s.node, s.edge); });
  return sides;
}

class Builder {
 public:
  Builder(std::span<const Float3> vertices, std::span<const TriangleIndices> triangles) {
    for (const Float3& vertex : vertices) {
      const Vec3 p = to_vec3(vertex);
      graph_.corners.push_back({.position = p, .connections = {}});
      largest_ = std::max(largest_, p.cwiseAbs().maxCoeff());
    }
    for (const TriangleIndices& t : triangles) {
      const Vec3 a = position(t[0]);
      const Vec3 normal = (position(t[1]) - a).cross(position(t[2]) - a).normalized();
      graph_.nodes.push_back(
          {.plane = {.normal = normal, .offset = normal.dot(a)}, .corners = t, .connections = {}});
    }
    add_connections(triangles);
  }

  ConnectionGraph graph() {
    for (std::uint32_t i = 0; i < graph_.connections.size(); ++i) {
      for (const std::uint32_t corner : graph_.connections[i].corners) {
        graph_.corners[corner].connections.push_back(i);
      }
    }
    find_corner_types();
    find_flat_faces();
    return std::move(graph_);
  }

 private:
  [[nodiscard]] const Vec3& position(std::uint32_t corner) const {
    return graph_.corners[corner].position;
  }

  // The connections get their numbers in the order of the first triangle that uses them.
  void add_connections(std::span<const TriangleIndices> triangles) {
    const std::vector<Side> sides = sides_of(triangles);
    std::vector<std::span<const Side>> edges;
    for (std::span<const Side> rest = sides; !rest.empty();) {
      const auto other = std::ranges::find_if(
          rest, [&](const Side& side) { return side.key != rest.front().key; });
      edges.push_back(rest.first(static_cast<std::size_t>(other - rest.begin())));
      rest = rest.subspan(edges.back().size());
    }
    std::ranges::sort(edges, {}, [](std::span<const Side> edge) {
      return std::pair(edge.front().node, edge.front().edge);
    });
    graph_.connections.reserve(edges.size());
    for (const std::span<const Side> edge : edges) {
      add_connection(edge);
    }
  }

  void add_connection(std::span<const Side> sides) {
    const auto number = static_cast<std::uint32_t>(graph_.connections.size());
    Connection& connection = graph_.connections.emplace_back();
    const GraphNode& first = graph_.nodes[sides.front().node];
    connection.corners = {first.corners[sides.front().edge],
                          first.corners[next_corner(sides.front().edge)]};
    const Vec3& from = position(connection.corners[0]);
    const Vec3& to = position(connection.corners[1]);
    connection.edge_vector = to - from;
    const Vec3 along = connection.edge_vector.normalized();
    connection.ends = {GraphPlane{.normal = -along, .offset = -along.dot(from)},
                       GraphPlane{.normal = along, .offset = along.dot(to)}};
    for (const Side& side : sides) {
      GraphNode& node = graph_.nodes[side.node];
      node.connections[side.edge] = number;
      const bool is_forward = node.corners[side.edge] == connection.corners[0];
      const Vec3 outward = (is_forward ? along : Vec3{-along}).cross(node.plane.normal);
      connection.nodes.push_back({.node = side.node,
                                  .edge = side.edge,
                                  .voronoi = {.normal = outward, .offset = outward.dot(from)}});
    }
    find_type(connection);
  }

  void find_type(Connection& connection) const {
    if (connection.nodes.size() == 1) {
      connection.type = ConnectionType::open;
      return;
    }
    if (connection.nodes.size() > 2) {
      connection.type = ConnectionType::non_manifold;
      return;
    }
    const ConnectedNode& other = connection.nodes[1];
    if (graph_.nodes[other.node].corners[other.edge] == connection.corners[0]) {
      connection.type = ConnectionType::inconsistent;
      return;
    }
    find_angle(connection);
  }

  // The angle by which the normal turns from the first face to the second about the edge vector is
  // above 0 where the second falls behind the first: a convex edge.
  void find_angle(Connection& connection) const {
    const Vec3& first = graph_.nodes[connection.nodes[0].node].plane.normal;
    const Vec3& second = graph_.nodes[connection.nodes[1].node].plane.normal;
    const double sine = first.cross(second).dot(connection.edge_vector.normalized());
    const double cosine = first.dot(second);
    const double width = std::min(width_of(connection, 0), width_of(connection, 1));
    if (std::abs(sine) > kFlatSine + kRounding * largest_ / width) {
      connection.type = sine > 0.0 ? ConnectionType::convex : ConnectionType::concave;
      connection.inner_angle = std::numbers::pi - std::atan2(sine, cosine);
    } else if (cosine > 0.0) {
      connection.type = ConnectionType::flat;
      connection.inner_angle = std::numbers::pi;
    } else {
      connection.type = ConnectionType::convex;
      connection.inner_angle = 0.0;
    }
  }

  // Returns the height of a face over the edge, which is the width of the face there.
  [[nodiscard]] double width_of(const Connection& connection, std::size_t side) const {
    const ConnectedNode& node = connection.nodes[side];
    const std::uint32_t opposite = graph_.nodes[node.node].corners[(node.edge + 2U) % 3U];
    return -node.voronoi.height(position(opposite));
  }

  void find_corner_types() {
    const std::vector<bool> pinched = pinched_corners();
    for (std::uint32_t i = 0; i < graph_.corners.size(); ++i) {
      Corner& corner = graph_.corners[i];
      std::array<std::size_t, kConnectionTypes> types{};
      for (const std::uint32_t connection : corner.connections) {
        ++types[static_cast<std::size_t>(graph_.connections[connection].type)];
      }
      const auto has = [&](ConnectionType type) {
        return types[static_cast<std::size_t>(type)] != 0;
      };
      if (has(ConnectionType::inconsistent) || has(ConnectionType::non_manifold) || pinched[i]) {
        corner.type = CornerType::irregular;
      } else if (has(ConnectionType::open)) {
        corner.type = CornerType::border;
      } else if (has(ConnectionType::convex)) {
        corner.type = has(ConnectionType::concave) ? CornerType::partly_convex : CornerType::convex;
      } else if (has(ConnectionType::concave)) {
        corner.type = CornerType::concave;
      }
    }
  }

  // Tells of each corner whether its triangles fall into groups that no connection at it joins. A
  // triangle's three corners have a number each; those of two triangles that share an edge are
  // joined at both ends.
  std::vector<bool> pinched_corners() {
    Groups groups(3 * graph_.nodes.size());
    const auto number = [&](const ConnectedNode& side, std::uint32_t corner) {
      const std::uint32_t k = side.edge;
      const bool is_first = graph_.nodes[side.node].corners[k] == corner;
      return 3 * side.node + (is_first ? k : next_corner(k));
    };
    for (const Connection& connection : graph_.connections) {
      for (const ConnectedNode& side : connection.nodes) {
        for (const std::uint32_t corner : connection.corners) {
          groups.join(number(connection.nodes.front(), corner), number(side, corner));
        }
      }
    }
    constexpr std::uint32_t kNoGroup = 0xffffffff;
    std::vector<std::uint32_t> group_of(graph_.corners.size(), kNoGroup);
    std::vector<bool> pinched(graph_.corners.size(), false);
    for (std::uint32_t i = 0; i < 3 * graph_.nodes.size(); ++i) {
      const std::uint32_t corner = graph_.nodes[i / 3].corners[i % 3];
      const std::uint32_t group = groups.of(i);
      pinched[corner] =
          pinched[corner] || (group_of[corner] != kNoGroup && group_of[corner] != group);
      group_of[corner] = group;
    }
    return pinched;
  }

  void find_flat_faces() {
    Groups groups(graph_.nodes.size());
    for (const Connection& connection : graph_.connections) {
      if (connection.type == ConnectionType::flat) {
        groups.join(connection.nodes[0].node, connection.nodes[1].node);
      }
    }
    for (std::uint32_t i = 0; i < graph_.nodes.size(); ++i) {
      const std::uint32_t first = groups.of(i);
      graph_.nodes[i].flat_face = first == i ? graph_.flat_faces++ : graph_.nodes[first].flat_face;
    }
  }

  ConnectionGraph graph_;
  // The largest magnitude of a coordinate.
  double largest_ = 0.0;
};

}  // namespace

ConnectionGraph connection_graph(std::span<const Float3> vertices,
                                 std::span<const TriangleIndices> triangles) {
  return Builder(vertices, triangles).graph();
}

}  // namespace tactus::host
