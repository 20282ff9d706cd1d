#include "rendering/bodies/buried_contact.h"

#include <algorithm>
#include <limits>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {
namespace {

// A point is looked at so far before a surface and behind it, m.
constexpr double kBefore_m = 1e-4;
// Surfaces nearer than this are flush, m: it is the margin of contacts. A face that rises by
// kRises_m is not.
constexpr double kFlush_m = 5e-4;
constexpr double kRises_m = 1e-3;
// A surface with a normal nearer than this, by its cosine, is met instead, and hides nothing.
constexpr double kInstead = 0.7;

// The face of a hull from which a point is farthest outward.
struct OutermostFace {
  // Without faces a hull holds nothing.
  double gap_m = std::numeric_limits<double>::infinity();
  Vec3 normal_W = Vec3::Zero();
};

OutermostFace outermost_face(const PlacedHull& hull, const Vec3& point_W) {
  OutermostFace outermost;
  for (std::size_t f = 0; f < hull.hull().faces.size(); ++f) {
    const Vec3 normal_W = hull.normal_W(f);
    const Vec3& on_face_W = hull.vertices_W()[hull.corners(f).front()];
    const double gap_m = normal_W.dot(point_W - on_face_W);
    if (f == 0 || gap_m > outermost.gap_m) {
      outermost = {.gap_m = gap_m, .normal_W = normal_W};
    }
  }
  return outermost;
}

// Returns true if the other part hides the part at a point with this outward normal.
bool hides(const PlacedHull& other, const PlacedHull& part, const Vec3& point_W,
           const Vec3& outward_W) {
  const OutermostFace face = outermost_face(other, point_W + kBefore_m * outward_W);
  if (face.gap_m > kFlush_m || face.normal_W.dot(outward_W) > kInstead) {
    return false;
  }
  const Vec3 above_W = point_W - kBefore_m * outward_W + kRises_m * face.normal_W;
  return outermost_face(part, above_W).gap_m > 0.0;
}

}  // namespace

bool is_buried(std::span<const PlacedHull> parts, const PlacedHull& part, const Manifold& manifold,
               double sign) {
  if (parts.size() == 1 || manifold.count == 0) {
    return false;
  }
  const Vec3 outward_W = sign * manifold.normal_W;
  return std::ranges::all_of(
      std::span(manifold.points).first(manifold.count), [&](const ManifoldPoint& point) {
        return std::ranges::any_of(parts, [&](const PlacedHull& other) {
          return &other != &part && hides(other, part, point.point_W, outward_W);
        });
      });
}

}  // namespace tactus::rendering
