// The projection is geometry alone: the planes, the tool and their normals. The materials come in
// afterwards: every active plane adds its friction circle, of mu times its part of the normal
// force.
#include "rendering/contact/active_constraints.h"

#include <algorithm>

#include "rendering/contact/corner_spring.h"
#include "rendering/contact/object_sweep.h"
#include "rendering/material/sliding_surface.h"

namespace tactus::rendering {
namespace {

// Weighs the pushes of surfaces of different stiffness, and with them their friction circles.
void weigh_by_stiffness(const SceneObjects& scene, const ProxyRest& rest,
                        const std::array<PlaneSpring, 3>& springs, ActiveConstraints& active) {
  active.stiffness_N_per_m = corner_spring(rest, springs).stiffness_N_per_m;
  active.circle = {};
  if (!(active.stiffness_N_per_m > 0.0)) {
    active.push_m = {};  // it is rounded to nothing
    return;
  }
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const double secant_N_per_m =
        springs[i].stiffness_N_per_m + springs[i].rise_N / rest.pressure_m[i];
    active.push_m[i] *= secant_N_per_m / active.stiffness_N_per_m;
    active.circle.add(scene.material(rest.planes[i].object).friction, active.push_m[i]);
  }
}

}  // namespace

ActiveConstraints find_active_constraints(const SceneObjects& scene, const FrictionFactors& factors,
                                          const ProxyState& state, const Vec3& h,
                                          ContactPlanes& planes, ProxyRest& rest) {
  ActiveConstraints active{.projection = planes.project(state.p_W, h)};
  const PlaneProjection& projection = active.projection;
  rest.plane_count = projection.active_count;
  rest.normal_W = Vec3::Zero();
  if (projection.active_count == 0) {
    return active;
  }
  std::array<PlaneSpring, 3> springs{};
  double total = 0.0;
  bool are_alike = true;
  for (std::size_t i = 0; i < projection.active_count; ++i) {
    const ContactPlane& contact = planes[projection.active[i]];
    const Material& material = scene.material(contact.object);
    const double pressure = projection.pressure_m[i];
    rest.planes[i] = contact;
    rest.pressure_m[i] = pressure;
    rest.normal_W += pressure * contact.plane.normal;
    springs[i] = state.unpressed.spring(contact, pressure, material.stiffness_N_per_m);
    are_alike = are_alike && springs[i].rise_N == 0.0 &&
                springs[i].stiffness_N_per_m == springs[0].stiffness_N_per_m;
    total += pressure;
    active.push_m[i] = factors.of(contact.object) * pressure;
    active.circle.add(material.friction, active.push_m[i]);
    active.are_cones = active.are_cones && is_plain_cone(material);
  }
  rest.normal_W.normalize();
  active.stiffness_N_per_m = springs[0].stiffness_N_per_m;
  if (!are_alike) {
    weigh_by_stiffness(scene, rest, springs, active);
  }
  // Shading has lifted the goal toward the proxy, so the pressures are those of a shallower tool.
  // The friction is that of the tool's real depth.
  if (factors.depth_m > 0.0) {
    const double deeper = factors.depth_m / total;
    std::ranges::for_each(active.push_m, [&](double& push_m) { push_m *= deeper; });
    active.circle.static_radius_m *= deeper;
    active.circle.dynamic_radius_m *= deeper;
  }
  return active;
}

LastContact hardest_contact(const ProxyRest& rest) {
  const std::size_t hardest = rest.hardest();
  if (rest.plane_count == 0 || rest.pressure_m[hardest] <= 0.0) {
    return {};
  }
  const ContactPlane& plane = rest.planes[hardest];
  return {.object = plane.object, .triangle = plane.triangle, .normal_W = rest.normal_W};
}

HeldBy holding_surfaces(const ProxyRest& rest) {
  HeldBy held_by;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    held_by.surfaces[i] = {.object = rest.planes[i].object, .triangle = rest.planes[i].triangle};
  }
  return held_by;
}

void keep_last_contact(const SceneObjects& scene, const LastContact& last_contact, const Vec3& p,
                       const Vec3& h, ProxyRest& rest) {
  if (last_contact.object == kNoObject) {
    return;
  }
  const Mover* const mover = scene.mover_of(last_contact.object);
  Nearest nearest =
      nearest_at(scene, last_contact.object, last_contact.triangle, point_in(mover, p));
  nearest.normal = direction_from(mover, nearest.normal);
  const Vec3 pull = p - h;
  // The last joint normal still pushes unless the tool is now on its other side; then the nearest
  // point decides. A normal that pulls gives no contact.
  const Vec3& normal =
      last_contact.normal_W.dot(pull) > 0.0 ? last_contact.normal_W : nearest.normal;
  const double pressure = normal.dot(pull);
  if (pressure <= 0.0) {
    return;
  }
  rest.normal_W = normal;
  rest.planes[0] = {.plane = {.normal = normal, .offset = normal.dot(p)},
                    .nearest = nearest,
                    .object = last_contact.object,
                    .triangle = last_contact.triangle};
  rest.pressure_m[0] = pressure;
  rest.plane_count = 1;
}

}  // namespace tactus::rendering
