#include "rendering/bodies/mesh_contact.h"

#include <algorithm>
#include <array>

#include "rendering/geometry/rigid_pose.h"

namespace tactus::rendering {
namespace {

// A surface that bends by less than this, rad, is flat.
constexpr double kLeastBend = 1e-4;
// The slack of the Voronoi regions, rad.
constexpr double kSlack = 0.01;
// A point this far outside of a triangle is still over it, m: the edges belong to both sides.
constexpr double kRim_m = 1e-9;
// A vertex may be over several triangles: where it is farther than this, m, behind one, and this
// many times deeper than behind another, it is not there that it has come in.
constexpr double kDeep_m = 1e-3;
constexpr double kDeeper = 4.0;

constexpr std::array<HullEdge, 1> kSegment{{{0, 1, 0, 0}}};

// Returns true if the point projects into the triangle.
bool is_over(const NearTriangle& triangle, const Vec3& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& from = triangle.corners_O[k];
    const Vec3 edge = triangle.corners_O[(k + 1) % 3] - from;
    const double inward = triangle.normal_O.cross(edge).dot(p - from);
    if (inward < 0.0 && inward * inward > kRim_m * kRim_m * edge.squaredNorm()) {
      return false;
    }
  }
  return true;
}

// Returns true if the way from one point to another does not lead before a plane.
bool is_behind(const Vec3& from, const Vec3& to, const Vec3& normal) {
  const Vec3 way = to - from;
  const double along = way.dot(normal);
  return along <= 0.0 || along * along <= kSlack * kSlack * way.squaredNorm();
}

// Returns true if a face of the hull has both ends of a segment farther beyond it than `reach_m`.
bool is_beyond_a_face(const PlacedHull& hull, const std::array<Vec3, 2>& ends, double reach_m) {
  for (std::size_t f = 0; f < hull.hull().faces.size(); ++f) {
    const Vec3 normal = hull.normal_W(f);
    const double nearest = std::min(ends[0].dot(normal), ends[1].dot(normal));
    if (nearest - hull.vertices_W()[hull.corners(f).front()].dot(normal) > reach_m) {
      return true;
    }
  }
  return false;
}

// Returns the corner of a triangle that is not on its edge with these two corners.
const Vec3& corner_across(const NearTriangle& triangle, std::uint32_t i, std::uint32_t j) {
  const TriangleIndices& n = triangle.numbers;
  if (n[0] != i && n[0] != j) {
    return triangle.corners_O[0];
  }
  return n[1] != i && n[1] != j ? triangle.corners_O[1] : triangle.corners_O[2];
}

}  // namespace

std::span<const Manifold> MeshContact::find(const MeshView& mesh, Sides sides,
                                            const PlacedHull& hull_O, double margin_m) {
  patches_.clear();
  near_.find(mesh, sides, hull_O, margin_m);
  add_vertices(hull_O, margin_m);
  add_edges(sides, hull_O, margin_m);
  return patches_.reduce();
}

void MeshContact::add_vertices(const PlacedHull& hull_O, double margin_m) {
  if (hull_O.hull().circles == nullptr) {
    std::ranges::for_each(hull_O.vertices_W(), [&](const Vec3& vertex) {
      add_vertex(vertex, hull_O.hull().radius_m, margin_m);
    });
    return;
  }
  // The points of a round solid that touch depend on the triangle; most of a mesh near by has few
  // normals.
  Vec3 last = Vec3::Zero();
  for (const NearTriangle& triangle : near_.all()) {
    if (triangle.stops && triangle.normal_O != last) {
      last = triangle.normal_O;
      const PlacedHull::RimPoints rim = hull_O.rim_points(last);
      std::ranges::for_each(std::span(rim.points).first(rim.count),
                            [&](const Vec3& point) { add_vertex(point, 0.0, margin_m); });
    }
  }
}

void MeshContact::add_vertex(const Vec3& vertex, double radius_m, double margin_m) {
  std::array<std::uint16_t, kMaxNearTriangles> over{};
  std::size_t count = 0;
  double least_depth = kMaxToolRadius_m;
  for (std::uint16_t t = 0; t < near_.all().size(); ++t) {
    const NearTriangle& triangle = near_.all()[t];
    const double separation = (vertex - triangle.corners_O[0]).dot(triangle.normal_O) - radius_m;
    if (triangle.stops && separation <= margin_m && is_over(triangle, vertex)) {
      over[count++] = t;
      least_depth = std::min(least_depth, std::max(-separation, 0.0));
    }
  }
  for (const std::uint16_t t : std::span(over).first(count)) {
    const Vec3& normal = near_.all()[t].normal_O;
    const double separation = (vertex - near_.all()[t].corners_O[0]).dot(normal) - radius_m;
    if (-separation <= std::max(kDeep_m, kDeeper * least_depth)) {
      patches_.add(normal, {.point_W = vertex - (radius_m + 0.5 * separation) * normal,
                            .separation_m = separation});
    }
  }
}

void MeshContact::add_edges(Sides sides, const PlacedHull& hull_O, double margin_m) {
  const auto all = near_.all();
  for (std::size_t t = 0; t < all.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint16_t other = all[t].across[k];
      const bool is_first = other == NearTriangle::kNone || t < other;
      const bool stops = all[t].stops || (other != NearTriangle::kNone && all[other].stops);
      if (is_first && stops && is_ridge(all[t], k)) {
        add_edge(all[t], k, sides, hull_O, margin_m);
      }
    }
  }
}

bool MeshContact::is_ridge(const NearTriangle& triangle, std::size_t k) const {
  if (triangle.across[k] == NearTriangle::kNone) {
    return !near_.is_partial();
  }
  const Vec3& from = triangle.corners_O[k];
  const Vec3 way = corner_across(near_.all()[triangle.across[k]], triangle.numbers[k],
                                 triangle.numbers[(k + 1) % 3]) -
                   from;
  const double below = -way.dot(triangle.normal_O);
  return below > 0.0 && below * below > kLeastBend * kLeastBend * way.squaredNorm();
}

void MeshContact::add_edge(const NearTriangle& triangle, std::size_t k, Sides sides,
                           const PlacedHull& hull_O, double margin_m) {
  const std::array<Vec3, 2> ends{triangle.corners_O[k], triangle.corners_O[(k + 1) % 3]};
  const Vec3 reach = hull_O.half_W() + Vec3::Constant(margin_m + hull_O.hull().radius_m);
  const Vec3 lower = ends[0].cwiseMin(ends[1]) - hull_O.middle_W();
  const Vec3 upper = ends[0].cwiseMax(ends[1]) - hull_O.middle_W();
  if ((lower.array() > reach.array()).any() || (upper.array() < -reach.array()).any() ||
      is_beyond_a_face(hull_O, ends, margin_m + hull_O.hull().radius_m)) {
    return;
  }
  edge_.place({.vertices_O = ends, .edges = kSegment}, RigidPose{});
  const Manifold manifold = manifold_of(edge_, hull_O, margin_m);
  if (manifold.count > 0 && is_outermost(triangle, k, sides, manifold.normal_W)) {
    patches_.add(manifold);
  }
}

bool MeshContact::is_outermost(const NearTriangle& triangle, std::size_t k, Sides sides,
                               const Vec3& normal) const {
  const std::uint32_t i = triangle.numbers[k];
  const std::uint32_t j = triangle.numbers[(k + 1) % 3];
  const Vec3& from = triangle.corners_O[k];
  const Vec3& to = triangle.corners_O[(k + 1) % 3];
  if (!is_behind(from, corner_across(triangle, i, j), normal)) {
    return false;
  }
  if (triangle.across[k] != NearTriangle::kNone) {
    if (!is_behind(from, corner_across(near_.all()[triangle.across[k]], i, j), normal)) {
      return false;
    }
  } else if (sides == Sides::one && !(normal.dot(triangle.normal_O) > 0.0)) {
    return false;
  }
  const bool leads_up = !is_behind(from, to, normal);
  if (!leads_up && is_behind(to, from, normal)) {
    return true;
  }
  // The contact is at an end of the edge: a vertex, with all of its triangles.
  const std::uint32_t end = leads_up ? j : i;
  const Vec3& vertex = leads_up ? to : from;
  return std::ranges::all_of(near_.all(), [&](const NearTriangle& t) {
    const bool has_end = std::ranges::find(t.numbers, end) != t.numbers.end();
    return !has_end || std::ranges::all_of(t.corners_O, [&](const Vec3& corner) {
      return is_behind(vertex, corner, normal);
    });
  });
}

}  // namespace tactus::rendering
