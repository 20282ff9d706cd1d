#include "host_tools/bake/body/convex_hull.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "host_tools/bake/body/growing_hull.h"
#include "host_tools/bake/body/hull_faces.h"
#include "host_tools/bake/body/hull_lattice.h"
#include "host_tools/input_error.h"
#include "rendering/geometry/triangle.h"

namespace tactus::host {
namespace {

using rendering::Triangle;
using rendering::TriangleIndices;

// Points nearer to a place, a line or a plane than so many tolerances are on it.
constexpr double kFlatTolerances = 4.0;

std::string text_of_place(const Vec3& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x(), p.y(), p.z());
}

void require_points(std::span<const Vec3> points) {
  if (points.empty()) {
    throw InputError("a convex hull needs points, and there are none; check the mesh");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      throw InputError(fmt::format("vertex {} is not finite; repair the mesh", i));
    }
  }
}

// A point and its distance from what is there already, in units of the lattice.
struct FarPoint {
  double distance = 0.0;
  std::uint32_t index = 0;
};

// Returns the point with the greatest distance. Of those within the tolerance of it, the one that
// is farthest from the middle is taken: points that are equally far may lie on one face of the
// hull, and that one is a corner of it.
FarPoint farthest(const HullLattice& lattice, std::span<const FarPoint> points, double tolerance) {
  const double greatest = std::ranges::max(points, {}, &FarPoint::distance).distance;
  FarPoint best;
  double best_from_middle = -1.0;
  for (const FarPoint& p : points) {
    if (p.distance >= greatest - tolerance) {
      const double from_middle = lattice.place(p.index).squaredNorm();
      if (from_middle > best_from_middle) {
        best_from_middle = from_middle;
        best = p;
      }
    }
  }
  return best;
}

// Makes the hull of a lattice's points.
class HullBuilder {
 public:
  HullBuilder(std::span<const Vec3> points, double tolerance_m)
      : points_(points),
        lattice_(points),
        tolerance_m_(tolerance_m),
        tolerance_(tolerance_m / lattice_.unit_m()) {}

  // Returns the triangles of the hull. Throws InputError for points on a line or in a plane.
  std::vector<TriangleIndices> triangles(std::size_t most_vertices) {
    GrowingHull hull(lattice_, first_corners());
    measure_all([&](std::uint32_t i) { return hull.distance(i); });
    std::ranges::make_heap(far_points_, std::ranges::less{}, &FarPoint::distance);
    while (hull.vertex_count() < most_vertices) {
      const std::vector<FarPoint> best = take_farthest(hull);
      if (best.empty()) {
        break;
      }
      const FarPoint chosen = farthest(lattice_, best, tolerance_);
      hull.add(chosen.index);
      for (const FarPoint& p : best) {
        if (p.index != chosen.index) {
          far_points_.push_back(p);
          std::ranges::push_heap(far_points_, std::ranges::less{}, &FarPoint::distance);
        }
      }
    }
    return hull.triangles();
  }

 private:
  void measure_all(const std::function<double(std::uint32_t)>& distance) {
    far_points_.resize(points_.size());
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      far_points_[i] = {distance(i), i};
    }
  }

  // Returns four corners of the hull that span a volume.
  std::array<std::uint32_t, 4> first_corners() {
    std::array<std::uint32_t, 4> corners{};
    const auto find = [&](std::size_t place, const std::function<double(const Vec3&)>& distance) {
      measure_all([&](std::uint32_t i) { return distance(lattice_.place(i)); });
      const FarPoint found = farthest(lattice_, far_points_, tolerance_);
      corners[place] = found.index;
      return found.distance;
    };
    find(0, [](const Vec3& p) { return p.norm(); });
    const Vec3 a = lattice_.place(corners[0]);
    find(1, [&](const Vec3& p) { return (p - a).norm(); });
    const Vec3 b = lattice_.place(corners[1]);
    const Vec3 along = (b - a).normalized();
    if (find(2, [&](const Vec3& p) { return along.cross(p - a).norm(); }) <=
        kFlatTolerances * tolerance_) {
      throw InputError(fmt::format(
          "all points are within {:.2g} m of the line from {} to {} m, and a body needs a volume; "
          "give it a thickness, or check its scale",
          kFlatTolerances * tolerance_m_, text_of_place(points_[corners[0]]),
          text_of_place(points_[corners[1]])));
    }
    const Vec3 normal = along.cross(lattice_.place(corners[2]) - a).normalized();
    if (find(3, [&](const Vec3& p) { return std::abs(normal.dot(p - a)); }) <=
        kFlatTolerances * tolerance_) {
      throw InputError(fmt::format(
          "all points are within {:.2g} m of the plane through {} m with the normal {}, and a body "
          "needs a volume; give it a thickness, or check its scale",
          kFlatTolerances * tolerance_m_, text_of_place(points_[corners[0]]),
          text_of_place(normal)));
    }
    return corners;
  }

  // Takes out the points of which one is the farthest from the hull; none if all are within the
  // tolerance. The distances in the heap are of a smaller hull, and so upper bounds: those of the
  // first ones are measured anew until no other can exceed them.
  std::vector<FarPoint> take_farthest(const GrowingHull& hull) {
    std::vector<FarPoint> best;
    double greatest = tolerance_;
    while (!far_points_.empty() && far_points_.front().distance > greatest - tolerance_) {
      std::ranges::pop_heap(far_points_, std::ranges::less{}, &FarPoint::distance);
      FarPoint p = far_points_.back();
      far_points_.pop_back();
      p.distance = hull.distance(p.index);
      if (p.distance > tolerance_) {
        best.push_back(p);
        greatest = std::max(greatest, p.distance);
      }
    }
    return best;
  }

  std::span<const Vec3> points_;
  HullLattice lattice_;
  double tolerance_m_;
  double tolerance_;  // in units of the lattice
  std::vector<FarPoint> far_points_;
};

// Returns the sum of the triangles' normals, which is that of a polygon whose corners are not quite
// in one plane.
Vec3 normal_of(std::span<const Vec3> points, const HullPolygon& polygon) {
  Vec3 sum = Vec3::Zero();
  const Vec3& first = points[polygon[0]];
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    sum += (points[polygon[k]] - first).cross(points[polygon[k + 1]] - first);
  }
  return sum.normalized();
}

ConvexHull hull_of(std::span<const Vec3> points, std::span<const HullPolygon> polygons) {
  ConvexHull hull;
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (const HullPolygon& polygon : polygons) {
    ConvexHull::Face& face = hull.faces.emplace_back();
    face.normal = normal_of(points, polygon);
    for (const std::uint32_t vertex : polygon) {
      const auto [number, is_new] =
          numbers.try_emplace(vertex, static_cast<std::uint32_t>(hull.vertices.size()));
      if (is_new) {
        hull.vertices.push_back(points[vertex]);
      }
      face.vertices.push_back(number->second);
    }
  }
  for (ConvexHull::Face& face : hull.faces) {
    face.offset_m = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : hull.vertices) {
      face.offset_m = std::max(face.offset_m, face.normal.dot(v));
    }
  }
  return hull;
}

}  // namespace

double hull_tolerance_m(std::span<const Vec3> points) {
  constexpr double kShare = 2.0 * static_cast<double>(std::numeric_limits<float>::epsilon());
  double largest = 0.0;
  for (const Vec3& p : points) {
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  return kShare * largest;
}

ConvexHull convex_hull(std::span<const Vec3> points, std::size_t most_vertices) {
  require_points(points);
  const double tolerance = hull_tolerance_m(points);
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) {
    box.extend(p);
  }
  if (box.sizes().maxCoeff() <= kFlatTolerances * tolerance) {
    throw InputError(fmt::format(
        "all points are within {:.2g} m of {} m, and a body needs a volume; check the mesh and its "
        "scale",
        kFlatTolerances * tolerance, text_of_place(points.front())));
  }
  const auto triangles = HullBuilder(points, tolerance).triangles(most_vertices);
  ConvexHull hull = hull_of(points, join_coplanar(points, triangles, tolerance));
  hull.left_out_m = left_out_m(hull, points);
  return hull;
}

ConvexHull convex_hull(std::span<const rendering::Float3> points, std::size_t most_vertices) {
  std::vector<Vec3> precise(points.size());
  std::ranges::transform(points, precise.begin(), rendering::to_vec3);
  return convex_hull(std::span<const Vec3>(precise), most_vertices);
}

std::vector<TriangleIndices> to_triangles(const ConvexHull& hull) {
  std::vector<TriangleIndices> triangles;
  for (const ConvexHull::Face& face : hull.faces) {
    for (std::size_t k = 1; k + 1 < face.vertices.size(); ++k) {
      triangles.push_back({face.vertices[0], face.vertices[k], face.vertices[k + 1]});
    }
  }
  return triangles;
}

double left_out_m(const ConvexHull& hull, std::span<const Vec3> points) {
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : to_triangles(hull)) {
    triangles.emplace_back(hull.vertices[a], hull.vertices[b], hull.vertices[c]);
  }
  // The nearest point is on a triangle that is seen from p, but for those that are bent.
  const double behind = hull_tolerance_m(hull.vertices);
  double greatest = 0.0;
  for (const Vec3& p : points) {
    if (std::ranges::all_of(hull.faces, [&](const ConvexHull::Face& face) {
          return face.normal.dot(p) <= face.offset_m;
        })) {
      continue;
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& triangle : triangles) {
      const double height = triangle.height(p);
      if (height >= -behind && height < nearest) {
        nearest = std::min(nearest, triangle.nearest(p).distance);
      }
    }
    greatest = std::max(greatest, nearest);
  }
  return greatest;
}

}  // namespace tactus::host
