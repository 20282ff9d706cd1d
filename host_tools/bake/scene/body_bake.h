// Makes the body of an object: its mass, its inertia and its hull.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host_tools/bake/body/convex_hull.h"
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

// A convex part of a body, in the frame of the scene.
struct BakedPart {
  // The primitive; nothing for a hull.
  std::optional<rendering::Primitive> primitive;
  BakedHull hull;
};

// A body as it goes into the image; its `hull` view is empty.
struct BakedBody {
  rendering::ObjectBody body;
  // Empty for a convex primitive, which is its own hull, and for a body of parts.
  BakedHull hull;
  std::vector<BakedPart> parts;
};

// Returns the arrays of a hull.
BakedHull arrays_of(const ConvexHull& hull);

// Returns the body of an object with this shape and mesh (frame of the scene); for a primitive the
// mesh is its picture. Adds to `warnings` where the hull, by which bodies meet, differs from the
// shape. Throws InputError without the file and the line. bake_parts() adds its parts.
BakedBody bake_body(const BodyDescription& description, const ShapeDescription& shape,
                    const Placement& placement, const BakedMesh& mesh,
                    std::vector<std::string>& warnings);

}  // namespace tactus::host
