// A shape with everything that a ConnectedMesh points into: hierarchy, neighbours, vertex normals.
#pragma once

#include <vector>

#include "rendering/surface/connected_mesh.h"
#include "tests/support/solid.h"

namespace tactus::testing {

class ConnectedSolid {
 public:
  explicit ConnectedSolid(const Shape& shape);

  [[nodiscard]] rendering::ConnectedMesh mesh() const {
    return {
        .mesh = solid_.object().mesh, .neighbours = neighbours_, .vertex_normals = vertex_normals_};
  }
  [[nodiscard]] const Shape& shape() const { return solid_.shape(); }

 private:
  Solid solid_;
  std::vector<std::array<std::uint32_t, 3>> neighbours_;
  std::vector<rendering::Float3> vertex_normals_;
};

// Returns how often the closed shape winds round q, by the solid angles of its triangles: 1 inside
// and 0 outside of a simple one.
double winding_number(const Shape& shape, const Vec3& q);

}  // namespace tactus::testing
