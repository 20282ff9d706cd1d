// A mesh in memory, as host tools make and change it.
#pragma once

#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// World frame, metres.
struct TriangleMesh {
  std::vector<rendering::Float3> vertices;
  std::vector<rendering::TriangleIndices> triangles;
  std::vector<rendering::CornerPlaces> corner_places;  // one a triangle, or none
};

}  // namespace tactus::host
