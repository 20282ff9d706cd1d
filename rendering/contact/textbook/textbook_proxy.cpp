#include "rendering/contact/textbook/textbook_proxy.h"

#include <algorithm>
#include <span>

#include "rendering/contact/tick_watcher.h"
#include "rendering/friction/cone.h"
#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Returns the point of the plane that is nearest to p.
Vec3 on_plane(const Plane& plane, const Vec3& p) {
  return p + plane.residual(p) * plane.normal;
}

}  // namespace

template <class Watch>
struct TextbookProxy::Tick {
  const TextbookSurface& surface;
  const Vec3& tool;
  FacetSearch search;
  [[no_unique_address]] const Watch watch;
  TextbookRest rest;
  // The facets that hold the god-object, in the order in which they were met, with their planes
  // raised by the push-out.
  std::array<Plane, 3> planes;
  std::array<std::uint32_t, 3> triangles{};
  std::size_t count = 0;

  [[nodiscard]] std::span<const Plane> held_by() const { return {planes.data(), count}; }
  [[nodiscard]] std::span<const std::uint32_t> facets() const { return {triangles.data(), count}; }

  // Adds a plane that holds the god-object.
  void hold(const Plane& plane, std::uint32_t triangle) {
    planes[count] = plane;
    triangles[count] = triangle;
    ++count;
  }

  // Returns the first facet on the segment but those in `passed`, and holds the god-object by it.
  FacetHit test(const Vec3& from, const Vec3& goal, std::span<const std::uint32_t> passed = {}) {
    const FacetHit hit = search.first(from, goal, passed);
    ++rest.segments;
    if (hit.is_hit() && count < planes.size()) {
      hold({.normal = hit.normal, .offset = hit.normal.dot(hit.point) + surface.push_out_m},
           hit.triangle);
    }
    return hit;
  }

  // Returns the place above a collision point.
  [[nodiscard]] Vec3 above(const FacetHit& hit) const {
    return hit.point + surface.push_out_m * hit.normal;
  }

  // Shows a segment that ended at `to`.
  void show(const Vec3& from, const Vec3& goal, const Vec3& to, const FacetHit& hit) const {
    watch.see(
        WatchedSegment{.from_O = from, .goal_O = goal, .to_O = to, .tool_O = tool, .hit = hit});
  }
};

void TextbookProxy::place(const Vec3& p) {
  p_ = p;
  friction_ = FrictionState::free;
  steps_ = 0;
}

// The nearest point of the first facet's plane is taken as it is, on the facet or beside it.
Vec3 TextbookProxy::follow_one_plane(auto& tick) const {
  const FacetHit hit = tick.test(p_, tick.tool);
  const Vec3 goal = hit.is_hit() ? on_plane(tick.planes[0], tick.tool) : tick.tool;
  tick.show(p_, tick.tool, goal, hit);
  return goal;
}

// Each segment begins at the god-object and ends at the point nearest to the tool in front of the
// planes so far. A facet that is a constraint already is passed. What is on the way to the last
// point is not asked.
Vec3 TextbookProxy::follow_sub_goals(auto& tick) const {
  Vec3 goal = tick.tool;
  while (tick.count < tick.planes.size()) {
    const FacetHit hit = tick.test(p_, goal, tick.facets());
    const Vec3 next =
        hit.is_hit() ? project_on_planes(tick.tool, tick.held_by()).point : Vec3{goal};
    tick.show(p_, goal, next, hit);
    if (!hit.is_hit()) {
      break;
    }
    goal = next;
  }
  return goal;
}

// The goal is projected on one plane after the other, so that on two planes that are not
// perpendicular it may lie behind the first again, which then stops the god-object a second time.
Vec3 TextbookProxy::follow_three_steps(auto& tick) const {
  Vec3 p = p_;
  Vec3 goal = tick.tool;
  for (std::size_t step = 0; step < tick.planes.size(); ++step) {
    const std::size_t held = tick.count;
    const FacetHit hit = tick.test(p, goal);
    const Vec3 to = hit.is_hit() ? tick.above(hit) : goal;
    tick.show(p, goal, to, hit);
    p = to;
    if (!hit.is_hit()) {
      break;
    }
    goal = on_plane(tick.planes[held], goal);
  }
  return p;
}

// `steps_` counts the collisions of the ticks before. A slide needs two ticks: one that finds the
// facet and one that follows it.
Vec3 TextbookProxy::follow_one_step(auto& tick) {
  Vec3 goal = tick.tool;
  for (std::size_t step = 0; step < steps_; ++step) {
    goal = on_plane(step_planes_[step], goal);
    tick.hold(step_planes_[step], kNoTriangle);
  }
  const FacetHit hit = tick.test(p_, goal);
  const Vec3 to = hit.is_hit() ? tick.above(hit) : goal;
  tick.show(p_, goal, to, hit);
  if (!hit.is_hit() || steps_ == step_planes_.size()) {
    steps_ = 0;
  } else {
    step_planes_[steps_] = tick.planes[steps_];
    ++steps_;
  }
  return to;
}

Vec3 TextbookProxy::follow(TextbookRule rule, auto& tick) {
  switch (rule) {
    case TextbookRule::one_plane:
      return follow_one_plane(tick);
    case TextbookRule::three_sub_goals:
      return follow_sub_goals(tick);
    case TextbookRule::three_step:
      return follow_three_steps(tick);
    default:
      return follow_one_step(tick);
  }
}

template <class Watch>
TextbookRest TextbookProxy::advance(TextbookRule rule, const TextbookSurface& surface,
                                    const Vec3& tool, std::size_t most_visits, Watch watch) {
  if (!tool.allFinite() || tool.cwiseAbs().maxCoeff() > kWorldBound_m) {
    return {.proxy = p_, .flags = kTouchToolInvalid};
  }
  Tick<Watch> tick{.surface = surface,
                   .tool = tool,
                   .search = {surface.mesh, surface.sides, most_visits},
                   .watch = watch,
                   .rest = {},
                   .planes = {}};
  const Vec3 goal = follow(rule, tick);
  TextbookRest& rest = tick.rest;
  rest.visited = most_visits - tick.search.left();
  rest.proxy = p_;
  if (tick.search.is_cut()) {
    rest.flags = kTouchIterationsExhausted;
    return rest;
  }
  rest.proxy = goal;
  if (tick.count > 0) {
    rest.planes = static_cast<std::uint8_t>(tick.count);
    rest.normal = tick.planes[0].normal;
    FrictionCircle circle;
    const PlaneProjection projection = project_on_planes(tool, tick.held_by());
    for (std::size_t i = 0; i < projection.active_count; ++i) {
      circle.add(surface.material.friction, projection.pressure_m[i]);
    }
    if (circle.static_radius_m > 0.0) {
      // Friction holds back from the foot of the god-object on the first facet's plane.
      const FrictionStep step =
          apply_cone(on_plane(tick.planes[0], p_), goal, circle,
                     friction_ == FrictionState::free ? FrictionState::stick : friction_);
      rest.proxy = step.goal;
      rest.friction = step.state;
    }
    rest.depth_m = (rest.proxy - tool).dot(rest.normal);
  }
  friction_ = rest.friction;
  p_ = rest.proxy;
  return rest;
}

template TextbookRest TextbookProxy::advance(TextbookRule, const TextbookSurface&, const Vec3&,
                                             std::size_t, Unwatched);
template TextbookRest TextbookProxy::advance(TextbookRule, const TextbookSurface&, const Vec3&,
                                             std::size_t, ObjectWatched);

}  // namespace tactus::rendering
