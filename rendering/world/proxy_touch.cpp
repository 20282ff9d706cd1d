// A tick of the shared proxy without detail is one advance and one force. With detail the goal of
// the advance is shifted (material/force_shading.h), and the advance is repeated from the start of
// the tick until the shift settles:
//
//   begin -> advance -> blend -> improve -> advance again -> blend -> improve ... -> force
//
// The blended force, with the stiffness K and the sideways part of corner_spring.h and the
// pressures w_i as weights, is
//
//   F = K (proxy - tool) + sideways - (sum w_i B_i (v - v_i)) / (sum w_i)
//
// so that it passes continuously from one surface to the next, as their pressures do.
#include "rendering/world/proxy_touch.h"

#include <algorithm>

#include "rendering/contact/no_pull.h"
#include "rendering/contact/tick_watcher.h"

namespace tactus::rendering {
namespace {

// The most advances of one tick.
constexpr int kMostPasses = 4;

// The motion beside an object that moves: no tool is at rest there.
constexpr double kMoves_m = 1.0;

// Returns the pose of the object's frame in this tick.
RigidPose pose_of(const SceneObjects& scene, std::uint32_t object) {
  const Mover* const mover = scene.mover_of(object);
  return mover == nullptr ? RigidPose{} : mover->X_WO;
}

// Returns the largest friction over the normal force that a surface may give in this state.
double most_friction(const FrictionParameters& friction, FrictionState state) {
  return state == FrictionState::stick ? std::max(friction.coulomb, friction.static_level)
                                       : friction.coulomb;
}

// Returns true if the proxy is free. A proxy in the middle of its path, which the next tick
// continues, does not count.
bool is_free(const ProxyRest& rest) {
  return rest.plane_count == 0 && (rest.flags & kTouchIterationsExhausted) == 0;
}

}  // namespace

void ProxyTouch::set_tool_radius(double tool_radius_m) {
  proxy_.set_tool_radius(tool_radius_m);
  shading_.set_tool_radius(tool_radius_m);
}

void ProxyTouch::place(const Vec3& p_W) {
  proxy_.place(p_W);
  shading_.reset();
  set_friction({});
  before_.count = 0;
  detailed_ = false;
  last_tool_W_ = p_W;
}

template <class Watch>
Touch ProxyTouch::touch(const SceneObjects& scene, const ToolState& tool, Watch watch) {
  tool_step_m_ = (tool.p_W - last_tool_W_).norm();
  proxy_.begin_friction(last_tool_W_, tool.p_W, scene.tick_s());
  last_tool_W_ = tool.p_W;
  first_pass_ = true;
  if (detailed_) {
    shading_.begin({.proxy_W = proxy_.position_W(),
                    .tool_W = tool.p_W,
                    .moved_m = scene.anything_moved() ? kMoves_m : tool_step_m_});
    set_friction(friction_);
  }
  ProxyRest rest = proxy_.advance(scene, tool.p_W + shading_.offset(), watch);
  BlendedSurface blended = return_to_surface(scene, tool, watch, rest);
  // A proxy that has just left a surface with detail needs its shading to be forgotten.
  if (blended.detailed || detailed_) {
    shade(scene, tool, watch, rest, blended);
    before_ = here_;
  }
  detailed_ = blended.detailed;
  grips_.count = 0;
  Touch touch;
  touch.proxy_W = proxy_.position_W();
  touch.sub_goals = rest.sub_goals;
  touch.planes = rest.plane_count;
  touch.flags = rest.flags;
  touch.short_of_goal_m = rest.short_of_goal_m;
  if (rest.plane_count > 0) {
    touch.friction = friction_state(scene, rest);
    set_force(scene, tool, rest, blended, touch);
  }
  watch.see_step(TickStep::force);
  proxy_.look_ahead(scene);
  watch.see_step(TickStep::collision);
  return touch;
}

template <class Watch>
void ProxyTouch::shade(const SceneObjects& scene, const ToolState& tool, Watch watch,
                       ProxyRest& rest, BlendedSurface& blended) {
  first_pass_ = false;
  for (int pass = 1; blended.detailed; ++pass) {
    if (shading_.is_at_rest()) {
      return;
    }
    const bool improves = shading_.improve({.normal_W = rest.normal_W,
                                            .lean = blended.lean,
                                            .depth_m = blended.depth_m,
                                            .interpolated = blended.interpolated});
    set_friction(blended.friction);
    if (!improves || pass == kMostPasses || !proxy_.can_advance_again()) {
      return;
    }
    rest = proxy_.advance_again(scene, tool.p_W + shading_.offset(), watch);
    blended = return_to_surface(scene, tool, watch, rest);
  }
  shading_.reset();
  set_friction({});
}

// Moves the proxy back when a lifted or shifted goal has taken it off the surface. The goal is
// lowered first, then set to the tool, and the proxy meets the surface if it is between them.
template <class Watch>
ProxyTouch::BlendedSurface ProxyTouch::return_to_surface(const SceneObjects& scene,
                                                         const ToolState& tool, Watch watch,
                                                         ProxyRest& rest) {
  if (is_free(rest) && shading_.lower()) {
    set_friction(friction_);
    rest = proxy_.advance_again(scene, tool.p_W + shading_.offset(), watch);
  }
  if (is_free(rest) && shading_.is_on()) {
    shading_.reset();
    set_friction(friction_);
    rest = proxy_.advance_again(scene, tool.p_W, watch);
  }
  return blend_surfaces(scene, tool, rest);
}

void ProxyTouch::set_friction(const FrictionFactors& of_surfaces) {
  friction_ = of_surfaces;
  FrictionFactors factors = of_surfaces;
  factors.depth_m = shading_.lifted_from_m();
  proxy_.set_friction_factors(factors);
}

// Sums over the planes that hold the proxy. A plane's weight is its pressure.
ProxyTouch::BlendedSurface ProxyTouch::blend_surfaces(const SceneObjects& scene,
                                                      const ToolState& tool,
                                                      const ProxyRest& rest) {
  here_.count = 0;
  BlendedSurface blended;
  double height = 0.0;
  std::array<PlaneSpring, 3> springs{};
  std::array<PlaneSpring, 3> plain_springs{};
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const ContactPlane& plane = rest.planes[i];
    const Object& object = scene[plane.object];
    const Material& material = scene.material(plane.object);
    const double push = rest.pressure_m[i];
    blended.pressure_m += push;
    const Vec3 surface_v = scene.velocity_W(plane.object, proxy_.position_W());
    blended.surface_v_W += push * surface_v;
    blended.damping_W += push * material.damping_Ns_per_m * (tool.v_W - surface_v);
    springs[i] = proxy_.unpressed().spring(plane, push, material.stiffness_N_per_m);
    plain_springs[i] = springs[i];
    if (object.detail.empty()) {
      continue;
    }
    // The detail changes K, leans the force, lowers the surface and scales the friction.
    const Detail detail = detail_of(scene, plane);
    blended.detailed = true;
    blended.interpolated = blended.interpolated || !object.detail.corner_normals.empty();
    springs[i].stiffness_N_per_m *= detail.stiffness_factor;
    springs[i].rise_N *= detail.stiffness_factor;
    blended.lean += push * lean_of(detail.normal_O, plane.plane.normal);
    height += push * detail.height_m;
    blended.friction.object[blended.friction.count] = plane.object;
    blended.friction.factor[blended.friction.count++] = detail.friction_factor;
  }
  if (rest.plane_count == 0) {
    return blended;
  }
  const Vec3 stretch_W = proxy_.position_W() - tool.p_W;
  blended.spring = corner_spring(rest, springs, stretch_W);
  blended.depth_m = stretch_W.dot(rest.normal_W);
  blended.effective_depth_m = blended.depth_m;
  if (blended.detailed) {
    blended.plain_spring = corner_spring(rest, plain_springs, stretch_W);
    blended.effective_depth_m = std::max(blended.depth_m + height / blended.pressure_m, 0.0);
    // The force's magnitude is that of the effective depth, so lean and friction are scaled to it.
    const double share = blended.depth_m > 0.0 ? blended.effective_depth_m / blended.depth_m : 0.0;
    blended.lean *= share / blended.pressure_m;
    blended.spring.sideways_W *= share;
    for (std::size_t i = 0; i < blended.friction.count; ++i) {
      blended.friction.factor[i] *= share;
    }
  }
  return blended;
}

Detail ProxyTouch::detail_of(const SceneObjects& scene, const ContactPlane& plane) {
  const Object& object = scene[plane.object];
  const RigidPose X_WO = pose_of(scene, plane.object);
  const Nearest& nearest = plane.nearest;
  const ContactPoint here{
      .object = plane.object,
      .point_O = X_WO.point_in(proxy_.position_W() - nearest.distance * nearest.normal)};
  here_.points[here_.count++] = here;
  if (first_pass_) {
    travel_m_ = travel_to(here);
  }
  SurfaceDetail stored = object.detail;
  if (object.deforms) {
    stored.corner_normals = {};  // they do not follow the vertices
  }
  Detail detail =
      detail_at(stored, {scene.mesh_O(plane.object).mesh, object.neighbours, object.vertex_normals},
                {.triangle = plane.triangle,
                 .feature = nearest.feature,
                 .edge = nearest.edge,
                 .point_O = here.point_O,
                 .normal_O = X_WO.direction_in(nearest.normal),
                 .travel_m = travel_m_});
  detail.normal_O = X_WO.direction(detail.normal_O);
  return detail;
}

// Returns how far the contact point moved in this tick, m. A new contact counts as moving at the
// tool's speed.
double ProxyTouch::travel_to(const ContactPoint& here) const {
  double travel = tool_step_m_;
  bool known = false;
  for (std::size_t i = 0; i < before_.count; ++i) {
    if (before_.points[i].object == here.object) {
      const double distance = (here.point_O - before_.points[i].point_O).norm();
      travel = known ? std::min(travel, distance) : distance;
      known = true;
    }
  }
  return travel;
}

// A tool that is deeper than the plane and above the bump's surface is in contact without a force.
void ProxyTouch::set_force(const SceneObjects& scene, const ToolState& tool, const ProxyRest& rest,
                           const BlendedSurface& blended, Touch& touch) {
  const ContactPlane& hardest = rest.planes[rest.hardest()];
  const Vec3 stretch = touch.proxy_W - tool.p_W;
  touch.normal_W = rest.normal_W;
  touch.depth_m = blended.depth_m;
  if (blended.effective_depth_m > 0.0 || !blended.detailed) {
    const Vec3 effective_stretch =
        blended.detailed
            ? Vec3{stretch - (blended.depth_m - blended.effective_depth_m) * rest.normal_W}
            : stretch;
    const CornerSpring& spring = blended.spring;
    const Vec3 spring_force = spring.stiffness_N_per_m * effective_stretch + spring.sideways_W;
    touch.force_W =
        without_pull(spring_force - blended.damping_W / blended.pressure_m, rest.normal_W);
    set_grips(scene, tool, rest, spring_force, touch);
    set_parts(stretch, blended, touch);
  }
  touch.contact = kind_of(hardest.nearest.feature);
  touch.object = hardest.object;
}

// A plane has the part of the spring's force that is along its normal, and of the rest the share of
// its pressure.
void ProxyTouch::set_grips(const SceneObjects& scene, const ToolState& tool, const ProxyRest& rest,
                           const Vec3& spring_force_W, const Touch& touch) {
  double pressures_m = 0.0;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    pressures_m += rest.pressure_m[i];
    grips_.count += is_body(scene[rest.planes[i].object]) ? 1U : 0U;
  }
  if (grips_.count == 0) {
    return;
  }
  const bool are_all = grips_.count == rest.plane_count;
  const double stretch_m = (touch.proxy_W - tool.p_W).norm();
  const double stiffness = stretch_m > 0.0 ? spring_force_W.norm() / stretch_m : 0.0;
  Vec3 rest_of_spring = spring_force_W;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    rest_of_spring -= stiffness * rest.pressure_m[i] * rest.planes[i].plane.normal;
  }
  Vec3 of_bodies = Vec3::Zero();
  grips_.count = 0;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const ContactPlane& plane = rest.planes[i];
    if (!is_body(scene[plane.object])) {
      continue;
    }
    const Material& material = scene.material(plane.object);
    const double share = rest.pressure_m[i] / pressures_m;
    const Vec3 point = touch.proxy_W - plane.nearest.distance * plane.nearest.normal;
    const Vec3 spring =
        stiffness * rest.pressure_m[i] * plane.plane.normal + share * rest_of_spring;
    grips_.grips[grips_.count++] = {
        .object = plane.object,
        .grip = {.point_W = point,
                 .normal_W = plane.plane.normal,
                 .spring_force_W = spring,
                 .stiffness_N_per_m = stiffness,
                 .damping_Ns_per_m = material.damping_Ns_per_m,
                 .share = share,
                 .bristle_N_per_m = share * bristle_stiffness(material.friction, stiffness),
                 .friction = most_friction(material.friction, touch.friction),
                 .tool_v_W = tool.v_W}};
    of_bodies += spring - share * material.damping_Ns_per_m *
                              (tool.v_W - scene.velocity_W(plane.object, touch.proxy_W));
  }
  grips_.proxy_force_W = touch.force_W;
  grips_.other_force_W = are_all ? Vec3{Vec3::Zero()} : Vec3{touch.force_W - of_bodies};
}

FrictionState ProxyTouch::friction_state(const SceneObjects& scene, const ProxyRest& rest) const {
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    if (has_friction(scene.material(rest.planes[i].object).friction)) {
      return proxy_.friction();
    }
  }
  return FrictionState::free;
}

// Splits the force into parts. Detail makes the normal part that of the effective depth, and leans
// the stretch by depth * lean.
void ProxyTouch::set_parts(const Vec3& stretch, const BlendedSurface& blended, Touch& touch) {
  const double stiffness = blended.spring.stiffness_N_per_m;
  touch.parts.friction_W = stiffness * (stretch - blended.depth_m * touch.normal_W);
  touch.parts.driven_power = touch.force_W.dot(blended.surface_v_W) / blended.pressure_m;
  if (blended.detailed) {
    const Vec3 along = stiffness * blended.depth_m * blended.lean;
    const double out_N = stiffness * blended.effective_depth_m -
                         blended.plain_spring.stiffness_N_per_m * blended.depth_m;
    touch.parts.friction_W -= along;
    touch.parts.texture_W = along + out_N * touch.normal_W;
  }
}

template Touch ProxyTouch::touch(const SceneObjects&, const ToolState&, Unwatched);
template Touch ProxyTouch::touch(const SceneObjects&, const ToolState&, Watched);

}  // namespace tactus::rendering
