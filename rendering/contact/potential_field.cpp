#include "rendering/contact/potential_field.h"

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// Returns the push for the signed distance at the tool's centre.
FieldPush push_out(const SurfaceSample& seen, double tool_radius_m) {
  const double depth = tool_radius_m - seen.distance_m;
  if (!(depth > 0.0)) {
    return {};
  }
  return {.depth_m = depth, .normal_W = seen.normal_W};
}

}  // namespace

FieldPush potential_field(const Primitive& primitive, const Vec3& tool_W, double tool_radius_m) {
  return push_out(sample(primitive, tool_W), tool_radius_m);
}

FieldPush potential_field(const ConnectedMesh& mesh, const Vec3& tool_W, double tool_radius_m) {
  if (squared_distance(mesh.mesh.nodes[0], tool_W) > tool_radius_m * tool_radius_m) {
    return {};
  }
  return push_out(sample(mesh, tool_W), tool_radius_m);
}

}  // namespace tactus::rendering
