// The room of the proxy's centre within a convex solid is convex. The planes that touch its walls
// at the place nearest to the tool bound it from everywhere, that place is the tool's projection on
// them, and the straight move there is free. So a proxy without friction arrives in one move.
//
// Elsewhere the place is not known in advance: the friction circle changes along the wall, and a
// torus bends both ways. With the pull q along the wall, its curvature k in the direction of the
// pull, the pressure d and the friction mu d, what is left of the pull falls by 1 + k (d + mu q) a
// metre (curved_path.cpp has the same law for a bulge). The proxy slides by Newton's step along the
// pull, and the next sub-goal takes the next step. Friction is opposite to the motion, so the
// proxy slides along the pull also where the wall bends more to one side than to the other.
#include "rendering/contact/round_walls.h"

#include <algorithm>
#include <array>
#include <span>

#include "rendering/contact/primitive_sweep.h"
#include "rendering/tick_budget.h"

namespace tactus::rendering {
namespace {

// The walls of a primitive that the proxy touches.
struct TouchedWalls {
  std::array<Nearest, Contacts::kMost> walls;
  std::size_t count = 0;

  void add(const SurfaceSample& wall, double side) {
    walls[count++] = {.distance = side * wall.distance_m, .normal = side * wall.normal_W};
  }
  [[nodiscard]] std::span<const Nearest> all() const { return {walls.data(), count}; }
};

// Returns the walls that the proxy touches as they are seen from another point: of a round wall the
// planes round the side of that point. Distances are below 0 beyond a wall.
TouchedWalls walls_from(const ProxyAtWalls& at, const Candidate& candidate, const Vec3& from) {
  const Primitive& primitive = *candidate.primitive;
  const double side = candidate.seen.distance_m < 0.0 ? -1.0 : 1.0;
  TouchedWalls touched;
  const SurfaceSamples here = all_contacts(primitive, at.p);
  if (here.count == 0) {
    touched.add(sample(primitive, from), side);
    return touched;
  }
  const double reach_m = at.near.margins.of(candidate.point_tool).reach_m;
  const SurfaceSamples there = all_contacts(primitive, from);
  for (std::size_t i = 0; i < std::min(here.count, there.count); ++i) {
    const std::size_t nearest = i < here.round_count ? 0 : i;
    if (side * here.samples[nearest].distance_m <= reach_m) {
      touched.add(there.samples[i], side);
    }
  }
  return touched;
}

// Returns the point nearest to `from` that the contact planes and the touched walls allow;
// `otherwise` if they contradict each other.
Vec3 projected_on_walls(const ProxyAtWalls& at, const Vec3& from, const Vec3& otherwise) {
  // The contact planes, and the walls of two primitives or more.
  std::array<Plane, kMaxContactPlanes + 2 * Contacts::kMost> planes;
  std::size_t count = 0;
  for (const ContactPlane& contact : at.planes.all()) {
    planes[count++] = contact.plane;
  }
  const Primitive* last = nullptr;
  for (const ContactPlane& contact : at.planes.all()) {
    const Candidate& candidate = at.near.candidates.candidate(contact.candidate);
    if (!may_be_hollow(candidate) || candidate.primitive == last) {
      continue;
    }
    last = candidate.primitive;
    const double rest_m = at.near.margins.of(candidate.point_tool).rest_m;
    for (const Nearest& wall : walls_from(at, candidate, from).all()) {
      const double beyond = rest_m - wall.distance;
      if (beyond > 0.0 && count < planes.size()) {
        planes[count++] = {.normal = wall.normal, .offset = wall.normal.dot(from) + beyond};
      }
    }
  }
  const PlaneProjection projection = project_on_planes(from, std::span(planes).first(count));
  return projection.feasible ? projection.point : otherwise;
}

// Returns the curvature of the wall of a contact plane along a unit vector, 1/m, above 0 where it
// is hollow; 0 if it is not.
double hollow_curvature(const ProxyAtWalls& at, const ContactPlane& contact, const Vec3& along) {
  constexpr double kProbe_m = 1e-8;
  constexpr double kSameNormal = 1e-16;
  const Candidate& candidate = at.near.candidates.candidate(contact.candidate);
  if (!may_be_hollow(candidate)) {
    return 0.0;
  }
  const TouchedWalls here = walls_from(at, candidate, at.p);
  const TouchedWalls ahead = walls_from(at, candidate, at.p + kProbe_m * along);
  for (std::size_t i = 0; i < here.count; ++i) {
    const Vec3& normal = here.walls[i].normal;
    if ((normal - contact.plane.normal).squaredNorm() < kSameNormal) {
      return std::max(0.0, (normal - ahead.walls[i].normal).dot(along) / kProbe_m);
    }
  }
  return 0.0;
}

// Returns the place on the walls to which the proxy slides from `at.p` toward a goal on the contact
// planes. `pull_m` is the length of the slide without friction.
Vec3 slide_on_walls(const ProxyAtWalls& at, const Vec3& goal, double pull_m) {
  constexpr double kMostTurn_rad = 0.3;
  const Vec3 slide = goal - at.p;
  const double length = slide.norm();
  double pressure = 0.0;
  for (std::size_t i = 0; i < at.rest.plane_count; ++i) {
    pressure += at.rest.pressure_m[i];
  }
  if (!(length > 0.0) || !(pressure > 0.0)) {
    return goal;
  }
  const Vec3 along = slide / length;
  const double mu = std::max(0.0, pull_m - length) / pressure;
  double fall = 1.0;
  double bend = 0.0;
  for (std::size_t i = 0; i < at.rest.plane_count; ++i) {
    const double curvature = hollow_curvature(at, at.rest.planes[i], along);
    fall += curvature * (at.rest.pressure_m[i] + mu * pull_m);
    bend = std::max(bend, curvature);
  }
  if (bend == 0.0) {
    return goal;
  }
  const Vec3 guess = at.p + std::min(length / fall, kMostTurn_rad / bend) * along;
  return projected_on_walls(at, guess, goal);
}

// Returns true if all active planes are of walls whose room is convex.
bool is_room_convex(const ProxyAtWalls& at) {
  for (std::size_t i = 0; i < at.rest.plane_count; ++i) {
    const Primitive* const primitive =
        at.near.candidates.candidate(at.rest.planes[i].candidate).primitive;
    if (primitive != nullptr && !convex(*primitive)) {
      return false;
    }
  }
  return true;
}

}  // namespace

Vec3 goal_on_walls(const ProxyAtWalls& at, const Vec3& pulled_to, const HeldGoal& held) {
  at.near.candidates.budget().spend(kCostOfRoundWalls);
  return held.point != pulled_to || !is_room_convex(at)
             ? slide_on_walls(at, held.point, (pulled_to - at.p).norm())
             : projected_on_walls(at, held.tool, held.point);
}

}  // namespace tactus::rendering
