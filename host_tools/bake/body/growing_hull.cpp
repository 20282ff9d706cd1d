#include "host_tools/bake/body/growing_hull.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace tactus::host {

using rendering::TriangleIndices;

GrowingHull::GrowingHull(const HullLattice& lattice, const std::array<std::uint32_t, 4>& corners)
    : lattice_(&lattice) {
  auto [a, b, c, d] = corners;
  if (lattice.side(a, b, c, d) > 0) {
    std::swap(a, b);
  }
  add_face(a, b, c);
  add_face(a, d, b);
  add_face(b, d, c);
  add_face(c, d, a);
}

void GrowingHull::add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  faces_.push_back(
      {{a, b, c}, rendering::Triangle(lattice_->place(a), lattice_->place(b), lattice_->place(c))});
}

// The nearest point of a convex hull is on a face that is seen from the point.
double GrowingHull::distance(std::uint32_t point) const {
  const Vec3 p = lattice_->place(point);
  double nearest = std::numeric_limits<double>::infinity();
  for (const HullTriangle& face : faces_) {
    const double height = face.shape.height(p);
    if (height > 0.0 && height < nearest) {
      nearest = std::min(nearest, face.shape.nearest(p).distance);
    }
  }
  return nearest < std::numeric_limits<double>::infinity() ? nearest : 0.0;
}

// The beneath-beyond step: the faces that are seen from the point give way to the triangles between
// the point and their rim. A face in whose plane the point lies is not seen; it is joined by
// coplanar triangles.
bool GrowingHull::add(std::uint32_t point) {
  const auto seen =
      std::ranges::stable_partition(faces_, [&](const HullTriangle& face) {
        return lattice_->side(face.corners[0], face.corners[1], face.corners[2], point) <= 0;
      }).begin();
  if (seen == faces_.end()) {
    return false;
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (auto face = seen; face != faces_.end(); ++face) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.emplace_back(face->corners[k], face->corners[(k + 1) % 3]);
    }
  }
  faces_.erase(seen, faces_.end());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted = edges;
  std::ranges::sort(sorted);
  for (const auto& [from, to] : edges) {
    if (!std::ranges::binary_search(sorted, std::pair(to, from))) {
      add_face(from, to, point);
    }
  }
  return true;
}

std::vector<TriangleIndices> GrowingHull::triangles() const {
  std::vector<TriangleIndices> result(faces_.size());
  std::ranges::transform(faces_, result.begin(), &HullTriangle::corners);
  return result;
}

}  // namespace tactus::host
