#include "rendering/world/world.h"

#include <algorithm>

#include "rendering/contact/potential_field.h"
#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

bool valid(const ToolState& tool) {
  // Comparisons with a value that is not a number are false.
  return tool.p_W.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m &&
         tool.v_W.allFinite();
}

}  // namespace

bool World::set_scene(std::span<const Object> objects, const WorldConfig& config) {
  const bool good = objects.size() <= kMaxObjects && std::ranges::all_of(objects, usable) &&
                    config.tool_radius_m >= 0.0;
  objects_ = good ? objects : std::span<const Object>{};
  tool_radius_m_ = good ? config.tool_radius_m : 0.0;
  any_proxy_ = std::ranges::any_of(objects_, meets_proxy);
  proxy_.set_tool_radius(tool_radius_m_);
  reset();
  return good;
}

void World::reset() {
  placed_ = false;
}

void World::place(const Vec3& p_W) {
  proxy_.place(p_W);
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    trackers_[i].place(p_W);
    walkers_[i].place(p_W);
  }
  last_proxy_ = p_W;
  placed_ = true;
}

Touch World::touch(const ToolState& tool, ProxyPath* path) {
  Touch touch;
  if (!valid(tool)) {
    touch.proxy_W = last_proxy_;
    touch.flags = kTouchToolInvalid;
    return touch;
  }
  if (!placed_) {
    place(tool.p_W);
  }
  touch.proxy_W = tool.p_W;
  if (any_proxy_) {
    touch = proxy_.touch(objects_, tool, path);
  }
  Vec3 force = touch.force_W;
  double hardest = force.squaredNorm();
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    if (meets_proxy(objects_[i])) {
      continue;
    }
    Touch own = touch_alone(i, tool);
    force += own.force_W;
    own.flags |= touch.flags;
    const double push = own.force_W.squaredNorm();
    if (own.contact != ContactKind::none &&
        (push > hardest || touch.contact == ContactKind::none)) {
      hardest = push;
      touch = own;
    }
    touch.flags = own.flags;
  }
  touch.force_W = force;
  last_proxy_ = touch.proxy_W;
  return touch;
}

Touch World::touch_alone(std::uint32_t number, const ToolState& tool) {
  switch (objects_[number].method) {
    case ContactMethod::tracking:
      return touch_implicit(number, tool);
    case ContactMethod::feature_walk:
      return touch_features(number, tool);
    default:
      return touch_field(number, tool);
  }
}

Touch World::touch_features(std::uint32_t number, const ToolState& tool) {
  const Object& object = objects_[number];
  const FeatureRest rest =
      walkers_[number].advance({object.mesh, object.neighbours, object.vertex_normals},
                               object.sides, object.material.friction, tool.p_W);
  Touch touch;
  touch.proxy_W = rest.proxy_W;
  touch.flags = rest.flags;
  if (rest.contact != ContactKind::none) {
    touch.normal_W = rest.normal_W;
    touch.depth_m = rest.depth_m;
    touch.contact = rest.contact;
    touch.friction = rest.friction;
    touch.object = number;
    touch.planes = 1;
    touch.force_W = object.material.stiffness_N_per_m * (rest.proxy_W - tool.p_W) -
                    object.material.damping_Ns_per_m * tool.v_W;
  }
  return touch;
}

Touch World::touch_implicit(std::uint32_t number, const ToolState& tool) {
  const Object& object = objects_[number];
  const ImplicitRest rest =
      trackers_[number].advance(object.implicit, object.material.friction, tool.p_W);
  Touch touch;
  touch.proxy_W = rest.proxy_W;
  touch.sub_goals = rest.sub_goals;
  touch.planes = rest.planes;
  touch.flags = rest.flags;
  if (rest.planes > 0) {
    touch.normal_W = rest.normal_W;
    touch.depth_m = rest.depth_m;
    touch.contact = ContactKind::face;
    touch.friction = rest.friction;
    touch.object = number;
    touch.force_W = object.material.stiffness_N_per_m * (rest.proxy_W - tool.p_W) -
                    object.material.damping_Ns_per_m * tool.v_W;
  }
  return touch;
}

Touch World::touch_field(std::uint32_t number, const ToolState& tool) const {
  const Object& object = objects_[number];
  const Material& material = object.material;
  const FieldPush push =
      object.surface == SurfaceKind::primitive
          ? potential_field(object.primitive, material.stiffness_N_per_m, tool.p_W, tool_radius_m_)
          : potential_field({object.mesh, object.neighbours, object.vertex_normals},
                            material.stiffness_N_per_m, tool.p_W, tool_radius_m_);
  Touch touch;
  touch.proxy_W = tool.p_W + push.depth_m * push.normal_W;
  if (push.depth_m > 0.0) {
    touch.normal_W = push.normal_W;
    touch.depth_m = push.depth_m;
    touch.contact = ContactKind::face;
    touch.friction = FrictionState::slip;
    touch.object = number;
    touch.planes = 1;
    touch.force_W = push.force_W - material.damping_Ns_per_m * tool.v_W;
  }
  return touch;
}

}  // namespace tactus::rendering
