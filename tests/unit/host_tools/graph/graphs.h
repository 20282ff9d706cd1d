// Meshes and graphs for the tests of host_tools/graph.
#pragma once

#include <utility>

#include "host_tools/graph/connection_graph.h"
#include "tests/support/shapes.h"

namespace tactus::testing {

// An L of two squares, extruded: one groove.
inline Shape step() {
  Shape shape{.name = "step"};
  for (const float z : {0.0F, 2.0F}) {
    for (const auto& [x, y] : {std::pair{0.0F, 0.0F},
                               {3.0F, 0.0F},
                               {3.0F, 1.0F},
                               {1.0F, 1.0F},
                               {1.0F, 2.0F},
                               {0.0F, 2.0F}}) {
      shape.vertices.push_back({x, y, z});
    }
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    shape.triangles.push_back({i, j, 6 + j});
    shape.triangles.push_back({i, 6 + j, 6 + i});
  }
  for (std::uint32_t i = 1; i < 5; ++i) {
    shape.triangles.push_back({0, i + 1, i});
    shape.triangles.push_back({6, 6 + i, 7 + i});
  }
  return shape;
}

inline host::ConnectionGraph graph_of(const Shape& shape) {
  return host::connection_graph(shape.vertices, shape.triangles);
}

}  // namespace tactus::testing
