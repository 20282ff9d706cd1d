// Makes the body of an object: its mass, its inertia and its hull.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host_tools/bake/scene/body_description.h"
#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/placement.h"
#include "host_tools/bake/scene/shape_description.h"
#include "rendering/geometry/convex_hull.h"
#include "rendering/objects/object_body.h"

namespace tactus::host {

// The arrays of a hull, in the frame of the scene.
struct BakedHull {
  std::vector<Vec3> vertices;
  std::vector<rendering::HullFace> faces;
  std::vector<std::uint8_t> corners;
  std::vector<rendering::HullEdge> edges;
};

// A body as it goes into the image; its `hull` view is empty.
struct BakedBody {
  rendering::ObjectBody body;
  // Empty for a sphere, a capsule and a box, which are their own hulls.
  BakedHull hull;
};

// Returns the body of an object with this shape and mesh (frame of the scene); for a primitive the
// mesh is its picture. Adds to `warnings` where the hull, by which bodies meet, differs from the
// shape. Throws InputError without the file and the line.
BakedBody bake_body(const BodyDescription& description, const ShapeDescription& shape,
                    const Placement& placement, const BakedMesh& mesh,
                    std::vector<std::string>& warnings);

}  // namespace tactus::host
