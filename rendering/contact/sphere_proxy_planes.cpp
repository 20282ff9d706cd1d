// Collects the contact planes at the proxy.
//
// A triangle that is touched on its face gives its plane at once. One that is touched on an edge or
// a vertex gives its plane only when it blocks a sweep: across a flat or hollow seam the
// neighbour's edge is near too, its plane is tilted against the motion, and yet it never blocks. A
// face a little below a sphere that moved past the end of another face gives its plane too;
// otherwise the sphere would first have to come down to it.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "rendering/contact/sphere_proxy.h"

namespace tactus::rendering {

bool SphereProxy::collect_planes(const SceneObjects& scene, double most_push, ProxyRest& rest) {
  contact_count_ = 0;
  above_first_plane_ = false;
  found_overlap_ = false;
  for (const std::uint16_t i : candidate_set_.within_reach_here()) {
    if (candidate_set_.must_wait(i)) {
      return false;
    }
    const Nearest& nearest = candidate_set_.nearest(i, scene);
    const Candidate& candidate = candidate_set_.candidate(i);
    const ContactMargin& margin = margins_.of(candidate.point_tool);
    if (overlaps(candidate)) {
      found_overlap_ = candidate_set_.left_out().add(candidate.object) || found_overlap_;
      continue;
    }
    if (nearest.distance > margin.reach_m || candidate.behind) {
      continue;
    }
    if (nearest.feature == Feature::face || nearest.distance < margin.inner_m || is_blocking(i)) {
      add_plane(i, most_push, rest);
    }
  }
  if (contact_count_ > 0) {
    add_recalled_planes(scene, most_push, rest);
  }
  return true;
}

// A sphere is nearer to the back than its radius only if it is inside or comes through; outside,
// the front lies between.
bool SphereProxy::overlaps(const Candidate& candidate) const {
  constexpr double kBehind_m = 0.1e-6;
  const double slack_m = candidate.behind ? kBehind_m : kMostPushOut_m;
  return candidate.nearest.distance < margins_.of(candidate.point_tool).inner_m - slack_m;
}

// Adds the plane of the face a little below, after a move past the end of a face. The plane bounds
// the sphere there already, so the sphere need not come down first to find it.
void SphereProxy::add_face_below(const SceneObjects& scene, ProxyRest& rest) {
  constexpr double kLowest_m = 10e-6;
  double lowest = kLowest_m;
  std::size_t below = kNoCandidate;
  for (const std::uint16_t i : candidate_set_.within_reach(p_, kLowest_m)) {
    const Candidate& candidate = candidate_set_.candidate(i);
    const Triangle* const triangle = candidate_set_.triangle(i, scene);
    if (triangle == nullptr) {
      continue;
    }
    const double height = triangle->height(p_);
    const double above = (candidate.one_sided ? height : std::abs(height)) -
                         margins_.of(candidate.point_tool).rest_m;
    if (above > 0.0 && above < lowest && triangle->faces(p_)) {
      lowest = above;
      below = i;
    }
  }
  if (below != kNoCandidate) {
    candidate_set_.nearest(below, scene);
    above_first_plane_ = add_plane(below, 0.0, rest);
  }
}

// Returns true if the next move would begin a cycle. In a flat valley the proxy can move back and
// forth within the contact margin: on either side it does not touch the other, and the nearest
// point of each plane lies beyond it. When it is about to return to where it came from, or would
// end no nearer to the tool than there, the triangles that held it there give their planes from any
// distance until the tick ends.
bool SphereProxy::would_cycle(const Vec3& goal, const Vec3& h) const {
  constexpr double kMaxShareOfMove = 0.25;
  const Vec3& from = last_constraints_.from;
  return last_constraints_.count > 0 &&
         ((goal - h).squaredNorm() >= (from - h).squaredNorm() ||
          (goal - from).norm() <= kMaxShareOfMove * (p_ - from).norm());
}

bool SphereProxy::recall_last_constraints() {
  const std::size_t before = recalled_count_;
  for (const std::size_t i :
       std::span(last_constraints_.candidates).first(last_constraints_.count)) {
    if (recalled_count_ < recalled_.size() && !has_plane(i)) {
      recalled_[recalled_count_++] = i;
    }
  }
  return recalled_count_ > before;
}

bool SphereProxy::has_plane(std::size_t i) const {
  const auto contacts = std::span(contacts_).first(contact_count_);
  const auto recalled = std::span(recalled_).first(recalled_count_);
  return std::ranges::find(contacts, i, &ContactPlane::candidate) != contacts.end() ||
         std::ranges::find(recalled, i) != recalled.end();
}

// The shape behind such a plane is convex, so the plane bounds the proxy from any distance.
void SphereProxy::add_recalled_planes(const SceneObjects& scene, double most_push,
                                      ProxyRest& rest) {
  for (const std::size_t i : std::span(recalled_).first(recalled_count_)) {
    candidate_set_.nearest(i, scene);
    const Candidate& candidate = candidate_set_.candidate(i);
    if (!candidate.behind && (candidate.primitive == nullptr || convex(*candidate.primitive))) {
      add_plane(i, most_push, rest);
    }
  }
}

bool SphereProxy::is_blocking(std::size_t i) const {
  const auto end = blocking_candidates_.begin() + static_cast<std::ptrdiff_t>(blocking_count_);
  return std::find(blocking_candidates_.begin(), end, i) != end;
}

bool SphereProxy::add_blocking_plane(std::size_t i, double most_push, ProxyRest& rest) {
  const Candidate& candidate = candidate_set_.candidate(i);
  if (candidate.nearest.distance > margins_.of(candidate.point_tool).reach_m) {
    return false;  // met during the sweep, not in contact at its start
  }
  return add_plane(i, most_push, rest);
}

bool SphereProxy::add_plane(std::size_t i, double most_push, ProxyRest& rest) {
  const Nearest& nearest = candidate_set_.candidate(i).nearest;
  const ContactMargin& margin = margins_.of(candidate_set_.candidate(i).point_tool);
  const double to_rest = margin.rest_m - nearest.distance;
  constexpr double kRounding_m = 1e-9;  // a sweep ends there
  const double push =
      nearest.distance < margin.inner_m - kRounding_m ? std::min(to_rest, most_push) : to_rest;
  const ContactPlane contact{
      .plane = {.normal = nearest.normal, .offset = nearest.normal.dot(p_) + push},
      .nearest = nearest,
      .object = candidate_set_.candidate(i).object,
      .triangle = candidate_set_.candidate(i).index,
      .candidate = i};
  // Triangles that share the nearest edge or vertex give the same plane.
  constexpr double kSameNormal = 1e-20;
  for (std::size_t k = 0; k < contact_count_; ++k) {
    if ((contacts_[k].plane.normal - contact.plane.normal).squaredNorm() < kSameNormal &&
        contacts_[k].plane.offset >= contact.plane.offset) {
      return false;
    }
  }
  if (contact_count_ < kMaxContactPlanes) {
    contacts_[contact_count_++] = contact;
    return true;
  }
  rest.flags |= kTouchPlanesOverflow;
  const auto farthest = std::ranges::max_element(
      contacts_, {}, [](const ContactPlane& c) { return c.nearest.distance; });
  if (contact.nearest.distance >= farthest->nearest.distance) {
    return false;
  }
  *farthest = contact;
  return true;
}

}  // namespace tactus::rendering
