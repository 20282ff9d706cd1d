// The walk of FeatureWalker, and the point's tick around it. An edge k of a triangle runs from its
// corner k to its corner k + 1, modulo 3. The distance to the tool is measured triangle by
// triangle, so an edge or a vertex is only the place on a triangle where its nearest point lies:
// the walk crosses there to the neighbours and asks whether one of them comes nearer.
#include "rendering/contact/feature_walk.h"

#include <algorithm>
#include <cmath>

#include "rendering/contact/sphere_sweep.h"
#include "rendering/friction/cone.h"
#include "rendering/geometry/hierarchy_query.h"
#include "rendering/limits.h"
#include "rendering/material/sliding_surface.h"

namespace tactus::rendering {
namespace {

constexpr std::uint32_t next_of(std::uint32_t k) {
  return (k + 1U) % 3U;
}
constexpr std::uint32_t previous_of(std::uint32_t k) {
  return (k + 2U) % 3U;
}

// Returns the triangle across edge k of t, if it is wound like t; then it runs through the edge in
// the other direction, and `shared` is its own number of the edge. Returns kNoTriangle at an open
// edge.
std::uint32_t across(const ConnectedMesh& mesh, std::uint32_t t, std::uint32_t k,
                     std::uint32_t& shared) {
  const std::uint32_t other = mesh.neighbours[t][k];
  if (other == kNoTriangle) {
    return kNoTriangle;
  }
  const TriangleIndices& own = mesh.mesh.triangles[t];
  const TriangleIndices& theirs = mesh.mesh.triangles[other];
  for (shared = 0; shared < 3; ++shared) {
    if (theirs[shared] == own[next_of(k)] && theirs[next_of(shared)] == own[k]) {
      return other;
    }
  }
  return kNoTriangle;
}

// One walk downhill in the distance to q.
class Walk {
 public:
  Walk(const ConnectedMesh& mesh, const Vec3& q, std::size_t limit)
      : mesh_(mesh), q_(q), limit_(limit) {}

  // Walks from a triangle until no step comes nearer or the limit is reached.
  FeatureWalk from(std::uint32_t triangle) {
    measure(triangle);
    while (result_.complete && step()) {
    }
    return result_;
  }

 private:
  // Takes one step from the feature at which the nearest point lies. Returns true if it came
  // nearer. A nearest point inside a face is the end: the face holds the tool.
  bool step() {
    const MeshFeature here = result_.at.feature;
    result_.at_border = false;
    if (here.kind == Feature::face) {
      return false;
    }
    if (here.kind == Feature::vertex) {
      return step_from_vertex(here);
    }
    std::uint32_t shared = 0;
    const std::uint32_t other = across(mesh_, here.triangle, here.number, shared);
    result_.at_border = other == kNoTriangle;
    return !result_.at_border && measure(other);
  }

  // Measures all triangles round a vertex: to one side and, if the ring is open there, to the
  // other. Every triangle of the ring is measured, so that the nearest is found and not the first
  // that is nearer. `corner` is the vertex's number in each triangle in turn. Returns true if one
  // came nearer.
  bool step_from_vertex(const MeshFeature& here) {
    bool nearer = false;
    for (const bool forward : {true, false}) {
      std::uint32_t t = here.triangle;
      std::uint32_t corner = here.number;
      while (result_.complete) {
        std::uint32_t shared = 0;
        t = across(mesh_, t, forward ? previous_of(corner) : corner, shared);
        if (t == kNoTriangle) {
          result_.at_border = true;
          break;
        }
        if (t == here.triangle) {
          return nearer;
        }
        corner = forward ? shared : next_of(shared);
        nearer = measure(t) || nearer;
      }
    }
    return nearer;
  }

  // Measures a triangle and moves there if it comes nearer to q by more than rounding: 1e-12 of the
  // squared distance is a nanometre to the side at a depth of a millimetre. Returns true if it
  // moved.
  bool measure(std::uint32_t triangle) {
    constexpr double kNearer = 1.0 - 1e-12;
    if (result_.visited > 0 && result_.visited >= limit_) {
      result_.complete = false;
      return false;
    }
    const MeshNearest there = nearest_on_triangle(mesh_.mesh, triangle, q_);
    ++result_.visited;
    if (result_.visited > 1 && !(there.squared_m2 < kNearer * result_.at.squared_m2)) {
      return false;
    }
    result_.at = there;
    return true;
  }

  const ConnectedMesh& mesh_;
  const Vec3& q_;
  std::size_t limit_;
  FeatureWalk result_;
};

// Visits the triangles along a sweep and keeps the first one that stops a point.
struct FirstContact {
  const MeshView& mesh;
  bool one_sided;
  const ContactMargin& margin;
  const Sweep& sweep;
  // The travel that is free so far, m, and the triangles that may still be measured.
  double free;
  std::size_t room;
  std::uint32_t triangle = kNoTriangle;

  [[nodiscard]] double reach() const { return free; }
  [[nodiscard]] bool exhausted() const { return room == 0; }
  void operator()(std::uint32_t t) {
    room -= room > 0 ? 1 : 0;
    const Triangle candidate = triangle_of(mesh, t);
    const double travel =
        travel_to_contact(candidate, one_sided, sweep, free, margin, candidate.nearest(sweep.from));
    if (travel < free) {
      free = travel;
      triangle = t;
    }
  }
};

// Returns true if the tool is a number and within the world.
bool in_reach(const Vec3& h) {
  return h.allFinite() && h.norm() <= kWorldBound_m;
}

}  // namespace

FeatureWalk walk_features(const ConnectedMesh& mesh, std::uint32_t triangle, const Vec3& q_W,
                          std::size_t limit) {
  return Walk(mesh, q_W, limit).from(triangle);
}

void FeatureWalker::place(const Vec3& p_W) {
  *this = FeatureWalker{};
  p_ = p_W;
}

FeatureRest FeatureWalker::advance(const ConnectedMesh& mesh, Sides sides, const Material& material,
                                   const Vec3& h_W, std::size_t most_visits) {
  if (!in_reach(h_W)) {
    return {.proxy_W = p_, .flags = kTouchToolInvalid};
  }
  most_visits_ = most_visits;
  return go(mesh, sides, material, h_W);
}

// A point that leaves one surface may meet the next in the same tick. The walk itself decides when
// it leaves: the nearest place of the surface has the tool in front, or lies on an open border off
// which the point slips.
FeatureRest FeatureWalker::go(const ConnectedMesh& mesh, Sides sides, const Material& material,
                              const Vec3& h_W) {
  // More rounds than this in one tick wait for the next one.
  constexpr int kRounds = 4;
  FeatureRest rest{.proxy_W = p_};
  const ContactMargin margin(0.0);
  for (int round = 0; round < kRounds; ++round) {
    if (!in_contact_ && !approach(mesh, sides, h_W, rest)) {
      rest.proxy_W = p_;
      return rest;
    }
    const FeatureWalk lowest = walk(mesh, feature_.triangle, h_W, rest);
    const double height = height_of(mesh, lowest.at, h_W);
    const bool clear = std::sqrt(lowest.at.squared_m2) > margin.rest_m;
    const bool off = height > 0.0 || lowest.at_border;
    if (!lowest.complete || !clear || !off) {
      settle(mesh, material, h_W, lowest, rest);
      return rest;
    }
    // The segment to the tool leads straight away from the surface; the point starts on it above
    // the contact margin, so that the next sweep does not meet the surface that it leaves.
    const Vec3 motion = h_W - lowest.at.point_W;
    p_ = lowest.at.point_W + margin.rest_m / motion.norm() * motion;
    in_contact_ = false;
    friction_ = FrictionState::free;
  }
  rest.flags |= kTouchIterationsExhausted;
  rest.proxy_W = p_;
  return rest;
}

// Sweeps the free point toward the tool through the hierarchy. Returns true if it met the surface.
// If the visits run out the point stops at the travel up to which everything was measured.
bool FeatureWalker::approach(const ConnectedMesh& mesh, Sides sides, const Vec3& h,
                             FeatureRest& rest) {
  const Vec3 motion = h - p_;
  const double length = motion.norm();
  if (!(length > 0.0)) {
    return false;
  }
  const ContactMargin margin(0.0);
  const Sweep sweep{.from = p_, .direction = motion / length};
  FirstContact visitor{.mesh = mesh.mesh,
                       .one_sided = sides == Sides::one,
                       .margin = margin,
                       .sweep = sweep,
                       .free = length,
                       .room = most_visits_};
  const double visited =
      visit_along(mesh.mesh.nodes, sweep.from, sweep.direction, margin.reach_m, visitor);
  rest.approached = static_cast<std::uint16_t>(rest.approached + most_visits_ - visitor.room);
  if (visited < visitor.free) {
    rest.flags |= kTouchIterationsExhausted;
    p_ += visited * sweep.direction;
    return false;
  }
  if (visitor.triangle == kNoTriangle) {
    p_ = h;
    return false;
  }
  const Vec3 stop = p_ + visitor.free * sweep.direction;
  const MeshNearest at = nearest_on_triangle(mesh.mesh, visitor.triangle, stop);
  // height_of() is relative to side_, so that is set to the front before the side is measured.
  side_ = 1.0;
  side_ = sides == Sides::two && height_of(mesh, at, stop) < 0.0 ? -1.0 : 1.0;
  p_ = at.point_W;
  feature_ = at.feature;
  friction_ = FrictionState::stick;
  in_contact_ = true;
  return true;
}

// Walks with the visits that this tick has left; one triangle is always measured.
FeatureWalk FeatureWalker::walk(const ConnectedMesh& mesh, std::uint32_t triangle, const Vec3& q,
                                FeatureRest& rest) const {
  const std::size_t left = most_visits_ - std::min<std::size_t>(rest.visited, most_visits_);
  const FeatureWalk result = walk_features(mesh, triangle, q, left);
  rest.visited = static_cast<std::uint16_t>(rest.visited + result.visited);
  if (!result.complete) {
    rest.flags |= kTouchIterationsExhausted;
  }
  return result;
}

// Returns the height of h over the surface, on the side of the contact. `at` is the nearest point.
// The pseudonormal of a face, edge or vertex gives the right sign there
// (rendering/surface/connected_mesh.h); the magnitude is the distance itself.
double FeatureWalker::height_of(const ConnectedMesh& mesh, const MeshNearest& at,
                                const Vec3& h) const {
  const double front = pseudonormal(mesh, at.feature).dot(h - at.point_W);
  return (front < 0.0 ? -side_ : side_) * std::sqrt(at.squared_m2);
}

// The friction circle about the lowest place holds the point where it was, or lets it slip to the
// rim. The rim is beside the surface, so a second walk from the lowest place finds the surface
// point there.
MeshNearest FeatureWalker::stay_in_friction_circle(const ConnectedMesh& mesh,
                                                   const FrictionParameters& friction, double depth,
                                                   const FeatureWalk& lowest, FeatureRest& rest) {
  const Vec3 held = nearest_on_triangle(mesh.mesh, feature_.triangle, p_).point_W;
  const FrictionCircle circle{.static_radius_m = friction.static_level * depth,
                              .dynamic_radius_m = friction.coulomb * depth};
  const FrictionStep step = apply_cone(held, lowest.at.point_W, circle, friction_);
  friction_ = step.state;
  if (step.state == FrictionState::stick) {
    return nearest_on_triangle(mesh.mesh, feature_.triangle, held);
  }
  return circle.dynamic_radius_m > 0.0 ? walk(mesh, lowest.at.feature.triangle, step.goal, rest).at
                                       : lowest.at;
}

// Settles the point in contact. `lowest` is where it would move without friction. The normal is the
// direction of the stretch, which is exact on faces, edges and vertices; a tool on the surface has
// none, and the pseudonormal serves.
void FeatureWalker::settle(const ConnectedMesh& mesh, const Material& material, const Vec3& h,
                           const FeatureWalk& lowest, FeatureRest& rest) {
  const double depth = std::max(0.0, -height_of(mesh, lowest.at, h));
  const Vec3 out = lowest.at.point_W - h;
  rest.normal_W = depth > 0.0 ? Vec3{out / depth}
                              : Vec3{side_ * pseudonormal(mesh, lowest.at.feature).normalized()};
  MeshNearest at = lowest.at;
  if (is_plain_cone(material)) {
    at = stay_in_friction_circle(mesh, material.friction, depth, lowest, rest);
  } else if (depth > 0.0) {
    const FrictionLag lag =
        model_.lag(sliding_surface(material), rest.normal_W, material.stiffness_N_per_m * depth);
    at = walk(mesh, lowest.at.feature.triangle, lowest.at.point_W - lag.lag_m, rest).at;
    friction_ = lag.state;
  }
  p_ = at.point_W;
  feature_ = at.feature;
  rest.contact = kind_of(at.feature.kind);
  rest.friction = friction_;
  // Within the contact margin in front of the surface the tool is in contact but not pushed.
  rest.proxy_W = depth > 0.0 ? p_ : h;
  rest.depth_m = (rest.proxy_W - h).dot(rest.normal_W);
}

}  // namespace tactus::rendering
