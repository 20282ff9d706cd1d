#include "rendering/contact/plane_collection.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "rendering/contact/friction_hold.h"
#include "rendering/contact/primitive_sweep.h"

namespace tactus::rendering {

// Planes are collected from the candidates that the tangent bounds show within reach; each of them
// is measured, unless the budget is spent. A surface gives its plane if it is touched on a face, if
// the proxy is below the margin of its edge or vertex (then it must be pushed out), or if it
// blocked a sweep in this tick, or if it held the proxy when the last tick ended.
PlaneCollector::Result PlaneCollector::collect(const ConstraintMemory& memory,
                                               const HeldBy& held_by, ContactPlanes& planes,
                                               std::uint32_t& flags) {
  CandidateSet& candidates = near_.candidates;
  planes.clear();
  bool found_overlap = false;
  RubbingEdges edges;
  for (const std::uint16_t i : candidates.within_reach_here()) {
    if (candidates.must_wait(i)) {
      return Result::unfinished;
    }
    const Nearest& nearest = candidates.nearest(i, near_.scene);
    const Candidate& candidate = candidates.candidate(i);
    const ContactMargin& margin = near_.margins.of(candidate.point_tool);
    if (overlaps(candidate)) {
      found_overlap = candidates.left_out().add(candidate.object) || found_overlap;
      continue;
    }
    if (nearest.distance > margin.reach_m || candidate.behind) {
      continue;
    }
    if (nearest.distance < margin.inner_m || !is_edge(candidate)) {
      add(i, planes, flags);
      add_other_contacts(i, planes, flags);
    } else if ((memory.is_blocking(i) || held_by.has({candidate.object, candidate.index})) &&
               !(rubs(candidate) && edges.add(i))) {
      add(i, planes, flags);
    }
  }
  add_edges(edges, planes, flags);
  if (!planes.empty()) {
    add_recalled(memory, planes, flags);
  }
  return found_overlap ? Result::overlapped : Result::complete;
}

void PlaneCollector::add_edges(const RubbingEdges& edges, ContactPlanes& planes,
                               std::uint32_t& flags) {
  if (edges.count == 0) {
    return;
  }
  const Vec3 raised_W = planes.resting_position(p_W_);
  for (const std::uint16_t i : std::span(edges.numbers).first(edges.count)) {
    if (!is_seam(i, planes) || !is_clear(i, raised_W)) {
      add(i, planes, flags);
    }
  }
}

std::optional<Vec3> PlaneCollector::place_above_seam(std::size_t i, ContactPlanes& planes) const {
  if (!is_seam(i, planes)) {
    return std::nullopt;
  }
  const Vec3 raised_W = planes.resting_position(p_W_);
  const bool is_low = (raised_W - p_W_).norm() > kUnevenRest_m;
  return is_low && is_clear(i, raised_W) ? std::optional(raised_W) : std::nullopt;
}

bool PlaneCollector::is_edge(const Candidate& candidate) const {
  return candidate.primitive == nullptr
             ? candidate.nearest.feature != Feature::face
             : rubs(candidate) && is_nearest_on_edge(*candidate.primitive, candidate.seen, p_W_);
}

bool PlaneCollector::rubs(const Candidate& candidate) const {
  const FrictionParameters& friction = near_.scene.material(candidate.object).friction;
  return friction.kind != FrictionKind::cone || friction.static_level > 0.0;
}

// A sphere that is lower than its rest height over a face, by as much as a sweep may end lower,
// meets the edge of the next face at a slant: for a point up to 48 degrees, and less the larger it
// is. Friction would take that slant for the slope of the surface.
bool PlaneCollector::is_seam(std::size_t i, const ContactPlanes& planes) const {
  const Candidate& candidate = near_.candidates.candidate(i);
  const ContactMargin& margin = near_.margins.of(candidate.point_tool);
  if (!rubs(candidate) || !is_edge(candidate)) {
    return false;
  }
  return std::ranges::any_of(planes.all(), [&](const ContactPlane& contact) {
    return contact.nearest.feature == Feature::face &&
           contact.nearest.normal.dot(candidate.nearest.normal) >= margin.inner_m / margin.stop_m;
  });
}

bool PlaneCollector::is_clear(std::size_t i, const Vec3& p_W) const {
  const Candidate& candidate = near_.candidates.candidate(i);
  const double distance_m = candidate.primitive == nullptr
                                ? candidate.triangle.nearest(p_W).distance
                                : sample(*candidate.primitive, p_W).distance_m;
  return distance_m >= near_.margins.of(candidate.point_tool).rest_m - kSettled_m;
}

// Returns true if the object overlaps the sphere. A sphere is nearer to the back than its radius
// only if it is inside or comes through; outside, the front lies between. So a tenth of a
// micrometre is enough to tell behind a surface, while in front rounding and deformations may leave
// kMaxPushOut_m.
bool PlaneCollector::overlaps(const Candidate& candidate) const {
  constexpr double kBehind_m = 0.1e-6;
  const double slack_m = candidate.behind ? kBehind_m : kMaxPushOut_m;
  return candidate.nearest.distance < near_.margins.of(candidate.point_tool).inner_m - slack_m;
}

// Adds planes of surfaces out of reach. The shape behind such a plane is convex, so the plane
// bounds the proxy from any distance.
void PlaneCollector::add_recalled(const ConstraintMemory& memory, ContactPlanes& planes,
                                  std::uint32_t& flags) {
  for (const std::size_t i : memory.recalled()) {
    near_.candidates.nearest(i, near_.scene);
    const Candidate& candidate = near_.candidates.candidate(i);
    if (!candidate.behind && (candidate.primitive == nullptr || convex(*candidate.primitive))) {
      add(i, planes, flags);
    }
  }
}

bool PlaneCollector::add_blocking(std::size_t i, ContactPlanes& planes, std::uint32_t& flags) {
  const Candidate& candidate = near_.candidates.candidate(i);
  if (candidate.nearest.distance > near_.margins.of(candidate.point_tool).reach_m) {
    return false;  // met during the sweep, not in contact at its start
  }
  return add(i, planes, flags);
}

// Adds the planes of the other points in which the sphere touches a primitive.
void PlaneCollector::add_other_contacts(std::size_t i, ContactPlanes& planes,
                                        std::uint32_t& flags) {
  const Candidate& candidate = near_.candidates.candidate(i);
  if (candidate.primitive == nullptr ||
      (candidate.seen.distance_m >= 0.0 && convex(*candidate.primitive))) {
    return;
  }
  const double reach_m = near_.margins.of(candidate.point_tool).reach_m;
  const SurfaceSamples contacts = all_contacts(*candidate.primitive, p_W_);
  for (std::size_t k = 0; k < contacts.count; ++k) {
    const Nearest contact = nearest_of(contacts.samples[k]);
    if (contact.distance <= reach_m) {
      add(i, contact, planes, flags);
    }
  }
}

bool PlaneCollector::add(std::size_t i, ContactPlanes& planes, std::uint32_t& flags) {
  return add(i, near_.candidates.candidate(i).nearest, planes, flags);
}

bool PlaneCollector::add(std::size_t i, const Nearest& nearest, ContactPlanes& planes,
                         std::uint32_t& flags) {
  const Candidate& candidate = near_.candidates.candidate(i);
  const ContactMargin& margin = near_.margins.of(candidate.point_tool);
  // The plane lies where the centre is at its rest height. A proxy above it comes down to it, which
  // keeps it in contact; one that a sweep left a little below rises to it.
  const double to_rest = margin.rest_m - nearest.distance;
  constexpr double kRounding_m = 1e-9;  // a sweep ends there
  const double push =
      nearest.distance < margin.inner_m - kRounding_m ? std::min(to_rest, max_push_m_) : to_rest;
  const Plane plane{.normal = nearest.normal, .offset = nearest.normal.dot(p_W_) + push};
  ContactPlane* const contact = planes.add(plane, nearest.distance, flags);
  if (contact == nullptr) {
    return false;
  }
  *contact = {.plane = plane,
              .nearest = nearest,
              .object = candidate.object,
              .triangle = candidate.index,
              .candidate = i};
  return true;
}

void PlaneCollector::add_face_below(ContactPlanes& planes, std::uint32_t& flags) {
  // The height to which a face counts as below the proxy: what a move past the end of a face may
  // leave.
  constexpr double kLowest_m = 10e-6;
  double lowest = kLowest_m;
  std::size_t below = kNoCandidate;
  for (const std::uint16_t i : near_.candidates.within_reach(p_W_, kLowest_m)) {
    const Candidate& candidate = near_.candidates.candidate(i);
    const Triangle* const triangle = near_.candidates.triangle(i, near_.scene);
    if (triangle == nullptr) {
      continue;
    }
    const double height = triangle->height(p_W_);
    const double above = (candidate.one_sided ? height : std::abs(height)) -
                         near_.margins.of(candidate.point_tool).rest_m;
    if (above > 0.0 && above < lowest && triangle->faces(p_W_)) {
      lowest = above;
      below = i;
    }
  }
  if (below != kNoCandidate) {
    near_.candidates.nearest(below, near_.scene);
    planes.set_above_first(add(below, planes, flags));
  }
}

// The test needs no measurement: each candidate within reach is asked whether the proxy projects
// inside its face. Only the face that held the proxy may say yes.
bool is_still_on_face(const NearbySurfaces& near, const Vec3& p_W, const ConstraintMemory& memory,
                      const ProxyRest& rest) {
  const ContactPlane& contact = rest.planes[0];
  if (rest.plane_count != 1 || contact.nearest.feature != Feature::face ||
      !memory.recalled().empty()) {
    return false;
  }
  bool is_held = false;
  for (const std::uint16_t i : near.candidates.within_reach_here()) {
    const Triangle* const triangle = near.candidates.triangle(i, near.scene);
    if (triangle == nullptr || memory.is_blocking(i) ||
        triangle->faces(p_W) != (i == contact.candidate)) {
      return false;
    }
    is_held = is_held || i == contact.candidate;
  }
  return is_held;
}

}  // namespace tactus::rendering
