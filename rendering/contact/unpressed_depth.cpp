#include "rendering/contact/unpressed_depth.h"

#include <algorithm>
#include <limits>
#include <span>

#include "rendering/contact/dual_basis.h"
#include "rendering/material/material.h"

namespace tactus::rendering {
namespace {

// Pressures that differ by less are the same to rounding, m.
constexpr double kSamePressure_m = 1e-12;

// Returns the object of all planes, kNoObject if there are several or none.
std::uint32_t only_object(const ProxyRest& rest) {
  const auto planes = std::span(rest.planes).first(rest.plane_count);
  const bool is_one = !planes.empty() && std::ranges::all_of(planes, [&](const auto& plane) {
    return plane.object == planes.front().object;
  });
  return is_one ? planes.front().object : kNoObject;
}

}  // namespace

PlaneSpring UnpressedDepths::kept_spring(const ContactPlane& contact, double pressure_m,
                                         double stiffness_N_per_m) const {
  const Plane* const plane = find(contact);
  return plane == nullptr ? PlaneSpring{.stiffness_N_per_m = stiffness_N_per_m}
                          : plane->spring(pressure_m, stiffness_N_per_m);
}

PlaneSpring UnpressedDepths::Plane::spring(double at_m, double stiffness_N_per_m) const {
  if (depth_m == 0.0) {
    return {.stiffness_N_per_m = stiffness_N_per_m};
  }
  if (at_m <= depth_m) {
    return {.stiffness_N_per_m = softer_N_per_m};
  }
  const double beyond_m = at_m - depth_m;
  const double harder_N_per_m = stiffness_N_per_m - softer_N_per_m;
  const double share = beyond_m / at_m;
  const double linear_N_per_m = softer_N_per_m + harder_N_per_m * share * share;
  const double force_N = softer_N_per_m * at_m + harder_N_per_m * beyond_m;
  return {.stiffness_N_per_m = linear_N_per_m, .rise_N = force_N - linear_N_per_m * at_m};
}

void UnpressedDepths::end_tick(const SceneObjects& scene, const ProxyRest& rest,
                               const ProxyStep& step) {
  const double softest_N_per_m = softest(scene);
  const std::uint32_t object = only_object(rest);
  if (rest.plane_count == 0 ||
      (object != kNoObject && scene.material(object).stiffness_N_per_m <= softest_N_per_m)) {
    count_ = 0;
    only_object_ = object;
    return;
  }
  UnpressedDepths next;
  const DualBasis dual = dual_basis(rest);
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const ContactPlane& contact = rest.planes[i];
    Plane& plane = next.planes_[next.count_++];
    plane = {.object = contact.object,
             .normal_W = contact.plane.normal,
             .pressure_m = rest.pressure_m[i],
             .dual_W = dual[i]};
    if (scene.material(plane.object).stiffness_N_per_m > softest_N_per_m) {
      const Vec3 surface_W = scene.tick_s() * scene.velocity_W(plane.object, step.p_W);
      const Plane* const before = find(contact);
      plane.add_unpressed(before == nullptr ? Plane{.dual_W = plane.dual_W} : *before,
                          surface_W - step.tool_step_W, softest_N_per_m);
    }
  }
  *this = next;
}

// The present stiffnesses are compared: a surface that becomes stiffer with time was held by none
// that is softer.
double UnpressedDepths::softest(const SceneObjects& scene) const {
  if (only_object_ != kNoObject) {
    return scene.material(only_object_).stiffness_N_per_m;
  }
  double softest_N_per_m = std::numeric_limits<double>::infinity();
  for (const Plane& plane : std::span(planes_).first(count_)) {
    const double own_N_per_m = scene.material(plane.object).stiffness_N_per_m;
    const PlaneSpring spring = plane.spring(plane.pressure_m, own_N_per_m);
    softest_N_per_m = std::min(softest_N_per_m, spring.stiffness_N_per_m);
  }
  return softest_N_per_m;
}

// The stretch has grown by step_W through the motion of tool and surface, and the pressure by the
// gradient along it. That is known no better than the gradient changes in the tick.
void UnpressedDepths::Plane::add_unpressed(const Plane& before, const Vec3& step_W,
                                           double softest_N_per_m) {
  const double pressed_m = 0.5 * (before.dual_W + dual_W).dot(step_W);
  const double unsure_m = 0.5 * (dual_W - before.dual_W).norm() * step_W.norm();
  const double grown_m = pressure_m - before.pressure_m - pressed_m - unsure_m;
  depth_m = before.depth_m;
  softer_N_per_m = before.softer_N_per_m;
  if (grown_m > kSamePressure_m) {
    softer_N_per_m =
        depth_m > 0.0 ? std::min(before.softer_N_per_m, softest_N_per_m) : softest_N_per_m;
    depth_m += grown_m;
  }
  depth_m = std::min(depth_m, pressure_m);
}

const UnpressedDepths::Plane* UnpressedDepths::find(const ContactPlane& contact) const {
  const Plane* found = nullptr;
  for (const Plane& plane : std::span(planes_).first(count_)) {
    if (plane.object == contact.object &&
        (found == nullptr || contact.plane.normal.dot(plane.normal_W - found->normal_W) > 0.0)) {
      found = &plane;
    }
  }
  return found;
}

}  // namespace tactus::rendering
