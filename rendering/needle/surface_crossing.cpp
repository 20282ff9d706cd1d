#include "rendering/needle/surface_crossing.h"

#include <algorithm>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// The signed volume of the motion and an edge. The edge is taken from its lower to its higher
// number, so that both of its triangles get the same number.
double volume(const MeshView& mesh, const Vec3& from, const Vec3& way, std::uint32_t i,
              std::uint32_t j) {
  const Vec3 a = to_vec3(mesh.vertices[std::min(i, j)]) - from;
  const Vec3 b = to_vec3(mesh.vertices[std::max(i, j)]) - from;
  const double size = way.dot(a.cross(b));
  return i < j ? size : -size;
}

// Collects the crossings of the triangles that a walk reaches.
class CrossingVisitor {
 public:
  CrossingVisitor(const MeshView& mesh, const Vec3& from, const Vec3& to)
      : mesh_(mesh), from_(from), to_(to), way_(to - from) {}

  void operator()(std::uint32_t t) {
    const TriangleIndices& corners = mesh_.triangles[t];
    const Vec3 a = to_vec3(mesh_.vertices[corners[0]]);
    const Vec3 b = to_vec3(mesh_.vertices[corners[1]]);
    const Vec3 c = to_vec3(mesh_.vertices[corners[2]]);
    const Vec3 normal = (b - a).cross(c - a);
    const double before = normal.dot(from_ - a);
    const double after = normal.dot(to_ - a);
    // A motion that ends on the plane has not crossed it; the next one does.
    if ((before > 0.0) == (after > 0.0)) {
      return;
    }
    const double u = volume(mesh_, from_, way_, corners[0], corners[1]);
    const double v = volume(mesh_, from_, way_, corners[1], corners[2]);
    const double w = volume(mesh_, from_, way_, corners[2], corners[0]);
    const bool is_through =
        (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    if (is_through) {
      add(before / (before - after), before > 0.0);
    }
  }
  [[nodiscard]] double reach() const { return way_.norm(); }

  [[nodiscard]] const SurfaceCrossing& found() const { return found_; }

 private:
  // If two crossings are at one place, as at a crease, the one inward counts.
  void add(double share, bool is_inward) {
    if (is_inward && (!found_.enters || share < found_.entry)) {
      found_.entry = share;
    }
    if (!is_inward && (!found_.leaves || share > found_.exit)) {
      found_.exit = share;
    }
    found_.enters = found_.enters || is_inward;
    found_.leaves = found_.leaves || !is_inward;
    if (share > last_ || (share == last_ && is_inward)) {
      last_ = share;
      found_.ends_inside = is_inward;
    }
  }

  const MeshView& mesh_;
  Vec3 from_;
  Vec3 to_;
  Vec3 way_;
  SurfaceCrossing found_;
  double last_ = -1.0;
};

// Returns the share of the way between one outside and one inside at which it crosses.
double halved(const Primitive& primitive, const Vec3& from, const Vec3& way, double outside,
              double inside) {
  constexpr int kCrossingHalvings = 40;
  for (int i = 0; i < kCrossingHalvings; ++i) {
    const double middle = 0.5 * (outside + inside);
    (sample(primitive, from + middle * way).distance_m < 0.0 ? inside : outside) = middle;
  }
  return inside;
}

// Returns the share of the way at which a motion from outside reaches the surface; 1 if it does
// not. It steps by the distance, which never passes the surface, or on a convex solid as far as the
// last two distances fall to 0 on a line. About a torus, which a way may graze and then enter, a
// step is no shorter than a micrometre: a way that is within the tube for less may be missed.
double first_hit(const Primitive& primitive, const Vec3& from, const Vec3& to) {
  constexpr int kMostCrossingSteps = 40;
  constexpr int kMostStepsAboutTorus = 1000;
  constexpr double kClose_m = 1e-9;
  constexpr double kLeastStep_m = 1e-6;
  const bool is_convex = primitive.kind != PrimitiveKind::torus;
  const Vec3 way = to - from;
  const double length = way.norm();
  double before = 0.0;
  double before_m = sample(primitive, from).distance_m;
  double share = before_m / length;
  const int most_steps = is_convex ? kMostCrossingSteps : kMostStepsAboutTorus;
  for (int i = 0; i < most_steps && (before_m > kClose_m || !is_convex); ++i) {
    share = std::min(share, 1.0);
    const double distance_m = sample(primitive, from + share * way).distance_m;
    if (distance_m < 0.0) {
      return halved(primitive, from, way, before, share);
    }
    if (share >= 1.0) {
      return 1.0;
    }
    double step = (is_convex ? distance_m : std::max(distance_m, kLeastStep_m)) / length;
    if (is_convex && distance_m < before_m) {
      step = std::max(step, distance_m * (share - before) / (before_m - distance_m));
    }
    before = share;
    before_m = distance_m;
    share += step;
  }
  return is_convex && before_m <= kClose_m ? before : 1.0;
}

}  // namespace

SurfaceCrossing crossing_of(const MeshView& mesh, const Vec3& from, const Vec3& to) {
  // The boxes are rounded to floats; the margin keeps what lies on their sides.
  constexpr double kMargin_m = 1e-6;
  const double length = (to - from).norm();
  CrossingVisitor visitor(mesh, from, to);
  if (length > 0.0) {
    visit_along(mesh.nodes, from, (to - from) / length, kMargin_m, visitor);
  }
  return visitor.found();
}

SurfaceCrossing crossing_of(const Primitive& primitive, const Vec3& from, const Vec3& to) {
  const double before = sample(primitive, from).distance_m;
  const double after = sample(primitive, to).distance_m;
  SurfaceCrossing found{.ends_inside = after < 0.0};
  const double length = (to - from).norm();
  if (before >= 0.0) {
    // A way that the distance covers cannot reach the surface.
    found.entry = before > length || length == 0.0 ? 1.0 : first_hit(primitive, from, to);
    found.enters = found.ends_inside || found.entry < 1.0;
  }
  if (after >= 0.0 && (before < 0.0 || found.enters)) {
    found.leaves = true;
    found.exit = length == 0.0 ? 1.0 : 1.0 - first_hit(primitive, to, from);
  }
  return found;
}

}  // namespace tactus::rendering
