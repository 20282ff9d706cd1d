#include "rendering/contact/contact_planes.h"

#include <algorithm>

namespace tactus::rendering {

ContactPlane* ContactPlanes::farthest_beyond(double distance_m) {
  const auto farthest = std::ranges::max_element(
      contacts_, {}, [](const ContactPlane& c) { return c.nearest.distance; });
  return distance_m < farthest->nearest.distance ? &*farthest : nullptr;
}

bool ContactPlanes::has(std::size_t number) const {
  return std::ranges::find(all(), number, &ContactPlane::candidate) != all().end();
}

bool ContactPlanes::allow(const Vec3& p) const {
  constexpr double kRounding_m = 1e-12;
  return std::ranges::all_of(all(), [&](const ContactPlane& c) {
    return c.plane.normal.dot(p) >= c.plane.offset - kRounding_m;
  });
}

PlaneProjection ContactPlanes::project(const Vec3& p, const Vec3& h) {
  constexpr double kSlack_m = 1e-12;  // keeps the proxy within its own planes in spite of rounding
  for (std::size_t i = 0; i < count_; ++i) {
    planes_[i] = contacts_[i].plane;
  }
  const std::span<Plane> used{planes_.data(), count_};
  const double now = (p - h).norm();
  PlaneProjection projection = project_on_planes(h, used);
  // The planes' rest heights may lift the proxy and so take it away from the tool, but by no more
  // than an overlap that is pushed out.
  if (projection.feasible && (projection.point - h).norm() <= now + kMaxPushOut_m) {
    return projection;
  }
  // The planes leave no room: surfaces push against each other. The proxy may slide between them,
  // but is not pushed.
  for (Plane& plane : used) {
    plane.offset = std::min(plane.offset, plane.normal.dot(p)) - kSlack_m;
  }
  projection = project_on_planes(h, used);
  projection.feasible = projection.feasible && (projection.point - h).norm() <= now;
  return projection;
}

// The planes that the proxy stands below are met by a projection of the proxy itself: the smallest
// motion that brings it to the rest height of all of them.
Vec3 ContactPlanes::resting_position(const Vec3& p) {
  Vec3 rest = p;
  if (is_above_first_) {
    const Plane& below = contacts_[0].plane;
    rest += (below.offset - below.normal.dot(p)) * below.normal;
  }
  bool low = false;
  for (std::size_t i = 0; i < count_; ++i) {
    planes_[i] = contacts_[i].plane;
    low = low || planes_[i].normal.dot(rest) < planes_[i].offset - kSettled_m;
  }
  if (!low) {
    return rest;
  }
  const PlaneProjection up = project_on_planes(rest, std::span(planes_).first(count_));
  return up.feasible && (up.point - p).norm() <= kMaxPushOut_m ? up.point : p;
}

}  // namespace tactus::rendering
