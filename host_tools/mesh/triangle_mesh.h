// A triangle mesh in memory, as host tools make and change it. The controller sees meshes only as
// parts of a baked image.
#pragma once

#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// An indexed mesh in the world frame, m.
struct TriangleMesh {
  std::vector<rendering::Float3> vertices;
  // Three indices into `vertices` each, counter-clockwise seen from outside.
  std::vector<rendering::TriangleIndices> triangles;
  // The texture places of a triangle's corners, one entry a triangle, or none at all.
  std::vector<rendering::CornerPlaces> corner_places;
};

}  // namespace tactus::host
