#include "rendering/contact/textbook/first_facet.h"

#include <algorithm>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// The boxes of the hierarchy grow by this much, far above the rounding of a search in it.
constexpr double kBoxMargin_m = 1e-9;

// Visits the facets along a segment and keeps the first that it crosses.
struct FirstFacet {
  const MeshView& mesh;
  bool one_sided;
  const Vec3& from;
  const Vec3& to;
  double length;
  std::span<const std::uint32_t> passed;
  std::size_t& left;
  // The travel to the first crossing so far, m.
  double travel;
  FacetHit hit;

  [[nodiscard]] double reach() const { return travel; }
  [[nodiscard]] bool exhausted() const { return left == 0; }

  void operator()(std::uint32_t t) {
    if (left == 0) {
      return;
    }
    --left;
    if (std::ranges::find(passed, t) != passed.end()) {
      return;
    }
    const Triangle facet = triangle_of(mesh, t);
    const double before = facet.height(from);
    const double after = facet.height(to);
    const bool crosses =
        (before > 0.0 && after <= 0.0) || (!one_sided && before < 0.0 && after >= 0.0);
    if (!crosses || !passes_through(t)) {
      return;
    }
    const double share = before / (before - after);
    if (share * length <= travel) {
      travel = share * length;
      hit = {.triangle = t,
             .point = from + share * (to - from),
             .normal = before > 0.0 ? facet.normal() : Vec3{-facet.normal()}};
    }
  }

  // Returns true if the line goes through the bar over the facet's edges. Two facets compute the
  // same numbers at the edge that they share, so that no line slips between them.
  [[nodiscard]] bool passes_through(std::uint32_t t) const {
    const TriangleIndices& corners = mesh.triangles[t];
    const Vec3 a = to_vec3(mesh.vertices[corners[0]]) - from;
    const Vec3 b = to_vec3(mesh.vertices[corners[1]]) - from;
    const Vec3 c = to_vec3(mesh.vertices[corners[2]]) - from;
    const Vec3 along = to - from;
    const double ab = along.dot(a.cross(b));
    const double bc = along.dot(b.cross(c));
    const double ca = along.dot(c.cross(a));
    return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
  }
};

}  // namespace

FacetHit FacetSearch::first(const Vec3& from, const Vec3& to,
                            std::span<const std::uint32_t> passed) {
  const double length = (to - from).norm();
  if (!(length > 0.0)) {
    return {};
  }
  FirstFacet visitor{.mesh = mesh_,
                     .one_sided = sides_ == Sides::one,
                     .from = from,
                     .to = to,
                     .length = length,
                     .passed = passed,
                     .left = left_,
                     .travel = length,
                     .hit = {}};
  visit_along(mesh_.nodes, from, (to - from) / length, kBoxMargin_m, visitor);
  return visitor.hit;
}

}  // namespace tactus::rendering
