#include "rendering/contact/implicit_planes.h"

#include <algorithm>

#include "rendering/geometry/tangential.h"

namespace tactus::rendering {

// `rise` is the way from the proxy's height, which is of first order, to the rest height.
Plane tangent_plane(const ImplicitSurface& surface, const ImplicitSample& here) {
  const double rise = kImplicitRest_m / surface.scale_m - here.height;
  return {.normal = here.normal, .offset = here.normal.dot(here.point) + rise};
}

Plane blocking_plane(ImplicitField& field, const Vec3& blocked_O, const Vec3& from_tool) {
  const ImplicitSample wall = sample(field, blocked_O);
  const Vec3 normal = wall.steepness > 0.0 ? wall.normal : from_tool.stableNormalized();
  return {.normal = normal,
          .offset = normal.dot(blocked_O) + kImplicitRest_m / field.surface().scale_m};
}

bool ImplicitPlanes::add(const Plane& plane) {
  constexpr double kSameNormal = 1e-20;
  const auto bounds_as_far = [&](const Plane& p) {
    return (p.normal - plane.normal).squaredNorm() < kSameNormal && p.offset >= plane.offset;
  };
  if (std::ranges::any_of(std::span(planes_).first(count_), bounds_as_far)) {
    return false;
  }
  planes_[count_ < planes_.size() ? count_++ : idle()] = plane;
  return true;
}

ImplicitPush ImplicitPlanes::push(const Vec3& h, const ImplicitSurface& surface) {
  ImplicitPush push{.projection = project(h)};
  const PlaneProjection& projection = push.projection;
  holding_ = projection.active;
  holding_count_ = projection.active_count;
  if (holding_count_ == 0) {
    return push;
  }
  for (std::size_t i = 0; i < holding_count_; ++i) {
    const double pressure_m = projection.pressure_m[i] * surface.scale_m;
    push.normal_W += pressure_m * (surface.R_WO * planes_[holding_[i]].normal);
    push.depth_m += pressure_m;
  }
  push.normal_W.normalize();
  if (holding_count_ == 2) {
    push.crease_W =
        surface.R_WO * crease_between(planes_[holding_[0]].normal, planes_[holding_[1]].normal);
  }
  return push;
}

// At most three planes hold the proxy, so one of the four is idle.
std::size_t ImplicitPlanes::idle() const {
  const auto holding = std::span(holding_).first(holding_count_);
  std::size_t i = 0;
  while (std::ranges::find(holding, i) != holding.end()) {
    ++i;
  }
  return i;
}

}  // namespace tactus::rendering
