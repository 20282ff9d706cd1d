#include "rendering/contact/textbook/first_facet.h"

#include <algorithm>
#include <array>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// The boxes of the hierarchy grow by this much, far above the rounding of a search in it.
constexpr double kBoxMargin_m = 1e-9;

// Returns the number of the axis along which the vector is longest.
Eigen::Index longest_axis(const Vec3& v) {
  Eigen::Index axis = 0;
  v.cwiseAbs().maxCoeff(&axis);
  return axis;
}

// Looks along a line and sees the points of space in a plane, where the line is the origin. The
// coordinates of a point are the same numbers for every facet that has it as a corner.
class Sight {
 public:
  // Looks from `from` along `along`, which is not zero.
  Sight(const Vec3& from, const Vec3& along)
      : from_(from),
        depth_(longest_axis(along)),
        right_share_(along[right()] / along[depth_]),
        up_share_(along[up()] / along[depth_]) {}

  // Returns a point as it is seen.
  [[nodiscard]] std::array<double, 2> of(const Float3& point) const {
    const Vec3 p = to_vec3(point) - from_;
    return {p[right()] - right_share_ * p[depth_], p[up()] - up_share_ * p[depth_]};
  }

 private:
  [[nodiscard]] Eigen::Index right() const { return (depth_ + 1) % 3; }
  [[nodiscard]] Eigen::Index up() const { return (depth_ + 2) % 3; }

  const Vec3& from_;
  // The axis that the line follows most, and the line's slopes over it.
  Eigen::Index depth_;
  double right_share_;
  double up_share_;
};

// Returns on which side of the origin the line from a to b passes: > 0 for the left. Rounding never
// gives it the wrong sign, since it keeps the order of the two products.
double side_of(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

// Visits the facets along a segment and keeps the first that it crosses.
struct FirstFacet {
  const MeshView& mesh;
  const Sight& sight;
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

  // Returns true if the line goes through the bar over the facet's edges (Woop, Benthin and Wald,
  // "Watertight ray/triangle intersection", Journal of Computer Graphics Techniques 2, 2013). No
  // line slips between facets that share an edge or a corner.
  [[nodiscard]] bool passes_through(std::uint32_t t) const {
    const TriangleIndices& corners = mesh.triangles[t];
    const auto a = sight.of(mesh.vertices[corners[0]]);
    const auto b = sight.of(mesh.vertices[corners[1]]);
    const auto c = sight.of(mesh.vertices[corners[2]]);
    const double ab = side_of(a, b);
    const double bc = side_of(b, c);
    const double ca = side_of(c, a);
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
  const Sight sight(from, to - from);
  FirstFacet visitor{.mesh = mesh_,
                     .sight = sight,
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
