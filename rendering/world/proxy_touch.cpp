#include "rendering/world/proxy_touch.h"

#include <algorithm>

namespace tactus::rendering {
Touch ProxyTouch::touch(const Scenery& scenery, const ToolState& tool, ProxyPath* path) {
  const ProxyRest rest = proxy_.advance(scenery, tool.p_W, path);
  Touch touch;
  touch.proxy_W = proxy_.position_W();
  touch.sub_goals = rest.sub_goals;
  touch.planes = rest.plane_count;
  touch.flags = rest.flags;
  if (rest.plane_count > 0) {
    set_force(scenery, tool, rest, touch);
  }
  return touch;
}

void ProxyTouch::set_force(const Scenery& scenery, const ToolState& tool, const ProxyRest& rest,
                           Touch& touch) const {
  const auto hardest = static_cast<std::size_t>(
      std::max_element(rest.pressure_m.begin(), rest.pressure_m.begin() + rest.plane_count) -
      rest.pressure_m.begin());
  double stiffness = 0.0;
  Vec3 damping = Vec3::Zero();
  double pressure = 0.0;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const Material& material = scenery[rest.planes[i].object].material;
    stiffness += rest.pressure_m[i] * material.stiffness_N_per_m;
    damping += rest.pressure_m[i] * material.damping_Ns_per_m *
               (tool.v_W - scenery.velocity_W(rest.planes[i].object, touch.proxy_W));
    pressure += rest.pressure_m[i];
  }
  const Vec3 stretch = touch.proxy_W - tool.p_W;
  touch.normal_W = rest.normal_W;
  touch.force_W = (stiffness * stretch - damping) / pressure;
  touch.depth_m = stretch.dot(rest.normal_W);
  touch.contact = kind_of(rest.planes[hardest].nearest.feature);
  touch.friction = proxy_.friction();
  touch.object = rest.planes[hardest].object;
}

}  // namespace tactus::rendering
