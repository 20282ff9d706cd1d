#include "tests/support/solid.h"

#include <utility>

#include "host_tools/mesh/hierarchy.h"

namespace tactus::testing {

Solid::Solid(Shape shape, rendering::Sides sides, const rendering::Material& material)
    : shape_(std::move(shape)) {
  host::Hierarchy hierarchy = host::build_hierarchy(shape_.vertices, shape_.triangles);
  std::vector<rendering::TriangleIndices> ordered;
  ordered.reserve(shape_.triangles.size());
  for (const std::uint32_t old : hierarchy.order) {
    ordered.push_back(shape_.triangles[old]);
  }
  shape_.triangles = std::move(ordered);
  nodes_ = std::move(hierarchy.nodes);
  object_ = {.mesh = {.vertices = shape_.vertices, .triangles = shape_.triangles, .nodes = nodes_},
             .sides = sides,
             .material = material};
}

}  // namespace tactus::testing
