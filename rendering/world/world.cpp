#include "rendering/world/world.h"

#include <algorithm>

#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

bool usable(const Object& object) {
  return !object.mesh.vertices.empty() && !object.mesh.triangles.empty() &&
         !object.mesh.nodes.empty();
}

bool valid(const ToolState& tool) {
  // Comparisons with a value that is not a number are false.
  return tool.p_W.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m &&
         tool.v_W.allFinite();
}

ContactKind kind_of(Feature feature) {
  switch (feature) {
    case Feature::face:
      return ContactKind::face;
    case Feature::edge:
      return ContactKind::edge;
    default:
      return ContactKind::vertex;
  }
}

}  // namespace

bool World::set_scene(std::span<const Object> objects, const WorldConfig& config) {
  const bool good = objects.size() <= kMaxObjects && std::ranges::all_of(objects, usable) &&
                    config.tool_radius_m >= 0.0;
  objects_ = good ? objects : std::span<const Object>{};
  proxy_.set_tool_radius(good ? config.tool_radius_m : 0.0);
  reset();
  return good;
}

void World::reset() {
  placed_ = false;
}

Touch World::touch(const ToolState& tool, ProxyPath* path) {
  Touch touch;
  if (!valid(tool)) {
    touch.proxy_W = proxy_.position_W();
    touch.flags = kTouchToolInvalid;
    return touch;
  }
  if (!placed_) {
    proxy_.place(tool.p_W);
    placed_ = true;
  }
  const ProxyRest rest = proxy_.advance(objects_, tool.p_W, path);
  touch.proxy_W = proxy_.position_W();
  touch.sub_goals = rest.sub_goals;
  touch.planes = rest.plane_count;
  touch.flags = rest.flags;
  if (rest.plane_count > 0) {
    add_force(tool, rest, touch);
  }
  return touch;
}

void World::add_force(const ToolState& tool, const ProxyRest& rest, Touch& touch) const {
  const auto hardest = static_cast<std::size_t>(
      std::max_element(rest.pressure_m.begin(), rest.pressure_m.begin() + rest.plane_count) -
      rest.pressure_m.begin());
  double stiffness = 0.0;
  double damping = 0.0;
  double pressure = 0.0;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const Material& material = objects_[rest.planes[i].object].material;
    stiffness += rest.pressure_m[i] * material.stiffness_N_per_m;
    damping += rest.pressure_m[i] * material.damping_Ns_per_m;
    pressure += rest.pressure_m[i];
  }
  const Vec3 stretch = touch.proxy_W - tool.p_W;
  touch.normal_W = rest.normal_W;
  touch.force_W = (stiffness * stretch - damping * tool.v_W) / pressure;
  touch.depth_m = stretch.dot(rest.normal_W);
  touch.contact = kind_of(rest.planes[hardest].nearest.feature);
  touch.friction = proxy_.friction();
  touch.object = rest.planes[hardest].object;
}

}  // namespace tactus::rendering
