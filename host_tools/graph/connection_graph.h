// The face-directed connection graph of a mesh: its faces as nodes, its edges as the connections
// between them, its vertices as corners, each with its type and the planes that bound its
// pseudo-Voronoi region. It is for the reader: the contact method feature_walk walks on the
// neighbours alone (rendering/contact/feature_walk.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// A plane: the points p with normal . p = offset, in the frame and unit of the mesh. The normal has
// unit length.
struct GraphPlane {
  Vec3 normal = Vec3::Zero();
  double offset = 0.0;

  // Returns the signed distance of p from the plane, above 0 on the side of the normal.
  [[nodiscard]] double height(const Vec3& p) const { return normal.dot(p) - offset; }
};

enum class ConnectionType : std::uint8_t {
  convex,
  concave,
  flat,
  open,
  inconsistent,
  non_manifold,
};
inline constexpr std::size_t kConnectionTypes = 6;

enum class CornerType : std::uint8_t { convex, concave, partly_convex, flat, border, irregular };
inline constexpr std::size_t kCornerTypes = 6;

// Return the type in words: "partly convex", "non-manifold".
std::string_view name_of(ConnectionType type);
std::string_view name_of(CornerType type);

// A face: a triangle of the mesh, with the same number.
struct GraphNode {
  // The face plane; its normal is on the front.
  GraphPlane plane;
  // The vertices in the triangle's order; connection k runs from corner k to corner k + 1.
  std::array<std::uint32_t, 3> corners{};
  std::array<std::uint32_t, 3> connections{};
  // The number of the polygon that this triangle and others make together, joined by flat
  // connections.
  std::uint32_t flat_face = 0;
};

// A node as its connection sees it.
struct ConnectedNode {
  std::uint32_t node = 0;
  // The number of the edge in the triangle, 0 to 2.
  std::uint32_t edge = 0;
  // The Voronoi plane: through the edge, perpendicular to the face. Points above it are beyond the
  // face.
  GraphPlane voronoi;
};

// An edge of the mesh.
struct Connection {
  // The shared vertices: the edge vector runs from the first to the second, with the first node on
  // its left as seen from the front.
  std::array<std::uint32_t, 2> corners{};
  Vec3 edge_vector = Vec3::Zero();
  // One or more, in the order of their numbers.
  std::vector<ConnectedNode> nodes;
  ConnectionType type = ConnectionType::open;
  // The angle between the two faces on the inside, rad, 0 to 2 pi; 0 for a type that has none.
  double inner_angle = 0.0;
  // The end planes: through each shared vertex, perpendicular to the edge. Points above one are
  // beyond the edge.
  std::array<GraphPlane, 2> ends;
};

// A vertex of the mesh, with the same number. One that no triangle uses has no connections and is
// flat.
struct Corner {
  Vec3 position = Vec3::Zero();
  CornerType type = CornerType::flat;
  // Rising.
  std::vector<std::uint32_t> connections;
};

struct ConnectionGraph {
  std::vector<GraphNode> nodes;
  // In the order in which the triangles first use them.
  std::vector<Connection> connections;
  std::vector<Corner> corners;
  // The number of polygons that flat connections make of the nodes.
  std::uint32_t flat_faces = 0;
};

// Computes the graph. A connection is flat if its angle differs from 180 degrees by less than
// 0.0001 rad, or by less than the vertices' rounding to float can turn the narrower face; any other
// sign is certain. Every triangle must have an area and three different vertices that exist. The
// time is proportional to the mesh.
ConnectionGraph connection_graph(std::span<const rendering::Float3> vertices,
                                 std::span<const rendering::TriangleIndices> triangles);

// The number of features of each type, and Euler's number.
struct GraphCounts {
  std::size_t nodes = 0;
  std::size_t connections = 0;
  // The corners, one for each vertex that a triangle uses.
  std::size_t corners = 0;
  std::array<std::size_t, kConnectionTypes> of_connections{};
  std::array<std::size_t, kCornerTypes> of_corners{};

  // Returns vertices - edges + faces: 2 for each closed part without a handle, and 2 less for each
  // handle.
  [[nodiscard]] std::int64_t euler() const {
    return static_cast<std::int64_t>(corners) - static_cast<std::int64_t>(connections) +
           static_cast<std::int64_t>(nodes);
  }
};
GraphCounts count(const ConnectionGraph& graph);

// Return the most by which p is on the wrong side of one of the planes that bound the region of a
// face, an edge or a vertex: at most 0 within the region, in the unit of the mesh. Only there can
// the feature hold the nearest point of the mesh.
double beyond_face(const ConnectionGraph& graph, std::uint32_t node, const Vec3& p);
double beyond_edge(const ConnectionGraph& graph, std::uint32_t connection, const Vec3& p);
double beyond_vertex(const ConnectionGraph& graph, std::uint32_t corner, const Vec3& p);

}  // namespace tactus::host
