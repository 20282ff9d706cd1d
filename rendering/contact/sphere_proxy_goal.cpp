// Chooses the sub-goal: the point nearest to the tool in front of all planes, as far as friction
// lets the proxy move.
#include <algorithm>
#include <cmath>

#include "rendering/contact/object_sweep.h"
#include "rendering/contact/sphere_proxy.h"
#include "rendering/friction/cone.h"
#include "rendering/geometry/tangential.h"
#include "rendering/material/sliding_surface.h"

namespace tactus::rendering {
namespace {

// A shorter move counts as none: its force is a micronewton at 1000 N/m.
constexpr double kSettled_m = 1e-9;
// A sticking proxy may be this far below its rest height; a higher one clears the seams that it
// slides over next.
constexpr double kUnevenRest_m = 50e-9;

}  // namespace

PlaneProjection SphereProxy::project(const Vec3& h) {
  constexpr double kSlack_m = 1e-12;  // keeps the proxy within its own planes in spite of rounding
  for (std::size_t i = 0; i < contact_count_; ++i) {
    planes_[i] = contacts_[i].plane;
  }
  const std::span<Plane> used{planes_.data(), contact_count_};
  const double now = (p_ - h).norm();
  PlaneProjection projection = project_on_planes(h, used);
  if (projection.feasible && (projection.point - h).norm() <= now + kMostPushOut_m) {
    return projection;
  }
  // The planes leave no room: surfaces push against each other. The proxy may slide between them,
  // but is not pushed.
  for (Plane& plane : used) {
    plane.offset = std::min(plane.offset, plane.normal.dot(p_)) - kSlack_m;
  }
  projection = project_on_planes(h, used);
  projection.feasible = projection.feasible && (projection.point - h).norm() <= now;
  return projection;
}

// Returns the position at the rest height of the planes. A sweep ends a little below it, where
// friction alone would leave the proxy and the next seam would block it; after a move past the end
// of a face the proxy is a little above.
Vec3 SphereProxy::resting_position() {
  Vec3 rest = p_;
  if (above_first_plane_) {
    const Plane& below = contacts_[0].plane;
    rest += (below.offset - below.normal.dot(p_)) * below.normal;
  }
  bool low = false;
  for (std::size_t i = 0; i < contact_count_; ++i) {
    planes_[i] = contacts_[i].plane;
    low = low || planes_[i].normal.dot(rest) < planes_[i].offset - kSettled_m;
  }
  if (!low) {
    return rest;
  }
  const PlaneProjection up = project_on_planes(rest, std::span(planes_).first(contact_count_));
  return up.feasible && (up.point - p_).norm() <= kMostPushOut_m ? up.point : p_;
}

// Projects the tool on the contact planes and returns the active constraints with their friction
// circle.
SphereProxy::ActiveConstraints SphereProxy::active_constraints(const SceneObjects& scene,
                                                               const Vec3& h, ProxyRest& rest) {
  ActiveConstraints active_constraints{.projection = project(h)};
  const PlaneProjection& projection = active_constraints.projection;
  rest.plane_count = projection.active_count;
  rest.normal_W = Vec3::Zero();
  if (projection.active_count == 0) {
    return active_constraints;
  }
  double total = 0.0;
  for (std::size_t i = 0; i < projection.active_count; ++i) {
    const ContactPlane& contact = contacts_[projection.active[i]];
    const Material& material = scene.material(contact.object);
    const double pressure = projection.pressure_m[i];
    rest.planes[i] = contact;
    rest.pressure_m[i] = pressure;
    rest.normal_W += pressure * contact.plane.normal;
    const double push = factors_.of(contact.object) * pressure;
    total += pressure;
    active_constraints.push_m += push;
    active_constraints.circle.static_radius_m += material.friction.static_level * push;
    active_constraints.circle.dynamic_radius_m += material.friction.coulomb * push;
    active_constraints.in_cone = active_constraints.in_cone && is_plain_cone(material);
  }
  rest.normal_W.normalize();
  if (factors_.depth_m > 0.0) {
    const double deeper = factors_.depth_m / total;
    active_constraints.push_m *= deeper;
    active_constraints.circle.static_radius_m *= deeper;
    active_constraints.circle.dynamic_radius_m *= deeper;
  }
  return active_constraints;
}

// Keeps the last contact in a tick that ends early, between two faces or while it waits for
// candidates. The surface that held the proxy last gives the force, if the tool presses toward it.
// If the proxy moved far from it since, its nearest point gives the normal.
void SphereProxy::keep_last_contact(const SceneObjects& scene, const Vec3& h,
                                    ProxyRest& rest) const {
  if (last_contact_.object == kNoObject) {
    return;
  }
  const Mover* const mover = scene.mover_of(last_contact_.object);
  Nearest nearest =
      nearest_at(scene, last_contact_.object, last_contact_.triangle, point_in(mover, p_));
  nearest.normal = direction_from(mover, nearest.normal);
  const Vec3 pull = p_ - h;
  const Vec3& normal =
      last_contact_.normal_W.dot(pull) > 0.0 ? last_contact_.normal_W : nearest.normal;
  const double pressure = normal.dot(pull);
  if (pressure <= 0.0) {
    return;
  }
  rest.normal_W = normal;
  rest.planes[0] = {.plane = {.normal = normal, .offset = normal.dot(p_)},
                    .nearest = nearest,
                    .object = last_contact_.object,
                    .triangle = last_contact_.triangle};
  rest.pressure_m[0] = pressure;
  rest.plane_count = 1;
}

SphereProxy::Goal SphereProxy::choose_goal(const SceneObjects& scene, const Vec3& h,
                                           ProxyRest& rest) {
  const ActiveConstraints active = active_constraints(scene, h, rest);
  if (active.projection.active_count == 0) {
    const bool arrived = (h - p_).squaredNorm() <= 0.0;
    if (arrived) {
      friction_ = FrictionState::free;
    }
    return {.point = h, .settled = arrived};
  }
  return active.in_cone ? goal_by_friction_circle(active.projection, active.circle, h, rest)
                        : goal_by_friction_model(scene, active.projection, h, rest, active.push_m);
}

SphereProxy::Goal SphereProxy::goal_by_friction_circle(const PlaneProjection& projection,
                                                       const FrictionCircle& circle, const Vec3& h,
                                                       const ProxyRest& rest) {
  const Vec3 from = projection.feasible ? resting_position() : p_;
  const FrictionStep step = apply_cone(from, projection.point, circle, friction_);
  slipped_ = slipped_ || step.state == FrictionState::slip;
  friction_ = slipped_ ? FrictionState::slip : step.state;
  if (step.state == FrictionState::stick || !projection.feasible) {
    const double away = (step.goal - p_).norm();
    return {.point = step.goal, .settled = away <= kUnevenRest_m || !projection.feasible};
  }
  return goal_along_surface(step.goal, h, rest);
}

// Returns the goal of a friction model. The surface with the largest pressure supplies the model,
// under the push of all surfaces.
SphereProxy::Goal SphereProxy::goal_by_friction_model(const SceneObjects& scene,
                                                      const PlaneProjection& projection,
                                                      const Vec3& h, const ProxyRest& rest,
                                                      double push_m) {
  double stiffness = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    stiffness += rest.pressure_m[i] * scene.material(rest.planes[i].object).stiffness_N_per_m;
    total += rest.pressure_m[i];
  }
  const std::uint32_t object = rest.planes[rest.hardest()].object;
  SlidingSurface surface = sliding_surface(scene.material(object));
  surface.stiffness_N_per_m = stiffness / total;
  surface.grain.direction = direction_from(scene.mover_of(object), surface.grain.direction);
  const FrictionLag lag = model_.lag(surface, rest.normal_W, surface.stiffness_N_per_m * push_m);
  friction_ = lag.state;
  if (!projection.feasible) {
    return {.point = p_, .settled = true};
  }
  return goal_along_surface(projection.point - lag.lag_m, h - lag.lag_m, rest);
}

SphereProxy::Goal SphereProxy::goal_along_surface(const Vec3& goal, const Vec3& h,
                                                  const ProxyRest& rest) {
  const Vec3 move = goal - p_;
  if (move.norm() <= kSettled_m) {
    return {.point = p_, .settled = true};
  }
  const Vec3 stretched = follow_curvature(move, h, rest);
  return {.point = p_ + stretched, .stretched = stretched != move};
}

// Lengthens a move on a curved path. On an edge or a vertex the sphere's centre moves on a cylinder
// or a sphere of the radius R, and tangent moves alone reduce the distance to the goal only by the
// ratio depth / R per sub-goal. A move lengthened by 1 / (1 - ratio) ends on the ray from the
// feature through the goal, and the next sub-goal drops straight onto it. If the tool lies beyond
// the feature the sphere rolls off in ever longer moves. Along the crease of two surfaces the ratio
// is that of the last two moves.
//
// The distance to the tool may grow during a lengthened move. A move is lengthened only if the
// plain move would end nearer to the tool than every plain move that was lengthened before in this
// tick.
Vec3 SphereProxy::follow_curvature(const Vec3& move, const Vec3& h, const ProxyRest& rest) {
  constexpr double kRollingOff = 4.0;
  constexpr double kRounding_m = 1e-12;
  const Curvature curvature = rest.plane_count == 1   ? curvature_at_feature(move, h, rest)
                              : rest.plane_count == 2 ? curvature_along_crease(move, rest)
                                                      : Curvature{};
  const double most = curvature.max_share_of_radius * rest.planes[0].nearest.distance / move.norm();
  if (curvature.ratio == 0.0 || most <= 1.0) {
    return move;
  }
  const double left = (p_ + move - h).norm();
  double& least_left = least_left_m_[rest.plane_count - 1U];
  if (left >= least_left) {
    return move;
  }
  least_left = left;
  const double stretch = curvature.ratio < 1.0
                             ? 1.0 / (1.0 - curvature.ratio)
                             : std::max(kRollingOff, 1.0 / (curvature.ratio - 1.0));
  const Vec3 stretched = move + (std::min(stretch, most) - 1.0) * curvature.part;
  const bool allowed = std::all_of(
      contacts_.begin(), contacts_.begin() + static_cast<std::ptrdiff_t>(contact_count_),
      [&](const ContactPlane& c) {
        return c.plane.normal.dot(p_ + stretched) >= c.plane.offset - kRounding_m;
      });
  return allowed ? stretched : move;
}

// Returns the curvature across an edge or at a vertex. If friction takes most of the pull, only the
// rest draws the proxy. The lateral pull d and the pressure p change along the path s across by d'
// = p / R - 1 and p' = -d / R, along the edge by -1 and 0. With the friction f = mu p the rest d -
// f changes by the ratio cos^2 (p + mu d) / R, where the angle is between the path and the
// direction across. It is a small difference and not known far ahead.
SphereProxy::Curvature SphereProxy::curvature_at_feature(const Vec3& move, const Vec3& h,
                                                         const ProxyRest& rest) const {
  constexpr double kMaxShareWithFriction = 0.03;
  const Nearest& nearest = rest.planes[0].nearest;
  if (nearest.feature == Feature::face) {
    return {};
  }
  const Vec3& normal = rest.planes[0].plane.normal;
  const Vec3 slide = tangential(move, normal);
  const double length = slide.norm();
  if (length == 0.0) {
    return {};
  }
  Vec3 across = slide;
  if (nearest.feature == Feature::edge) {
    const Triangle& triangle = candidate_set_.candidate(rest.planes[0].candidate).triangle;
    const Vec3 edge = triangle.edge(nearest.edge).normalized();
    across -= slide.dot(edge) * edge;
  }
  const double pressure = rest.pressure_m[0];
  const double pull = tangential(h - p_, normal).norm();
  const double held = pull - length;
  if (held <= length) {
    return {.ratio = pressure / nearest.distance, .part = across};
  }
  const double squared_cosine = across.squaredNorm() / (length * length);
  return {.ratio = squared_cosine * (pressure + held / pressure * pull) / nearest.distance,
          .part = slide,
          .max_share_of_radius = kMaxShareWithFriction};
}

SphereProxy::Curvature SphereProxy::curvature_along_crease(const Vec3& move,
                                                           const ProxyRest& rest) const {
  constexpr double kAligned = 0.99;
  const double length = last_crease_move_.norm();
  if (move.dot(last_crease_move_) <= kAligned * length * move.norm()) {
    return {};
  }
  const Vec3 crease = rest.planes[0].plane.normal.cross(rest.planes[1].plane.normal).normalized();
  return {.ratio = move.norm() / length, .part = move.dot(crease) * crease};
}

}  // namespace tactus::rendering
