// The first facet of a mesh that a line segment crosses, by the test of the lecture: the ends lie
// on opposite sides of the facet's plane, and the line goes through the bar that stands on its
// edges. The textbook's proxies (textbook_proxy.h) ask it once for each segment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"
#include "rendering/surface/connected_mesh.h"

namespace tactus::rendering {

// A facet that stops a point.
struct FacetHit {
  // The triangle's number; kNoTriangle if nothing stops the point.
  std::uint32_t triangle = kNoTriangle;
  // The point where the segment crosses it, m.
  Vec3 point = Vec3::Zero();
  // The unit normal toward the side from which the segment comes.
  Vec3 normal = Vec3::Zero();

  [[nodiscard]] bool is_hit() const { return triangle != kNoTriangle; }
};

// Searches the hierarchy of one mesh, with a limit on all searches together.
class FacetSearch {
 public:
  // Looks at facets from the sides `sides`: a one-sided facet stops only a point that comes from
  // its front. Measures at most `limit` triangles in all.
  FacetSearch(const MeshView& mesh, Sides sides, std::size_t limit)
      : mesh_(mesh), sides_(sides), left_(limit) {}

  // Returns the first facet that the segment crosses, other than those in `passed`. A segment that
  // ends on a facet crosses it, one that begins there does not. Points are in the mesh's frame, m.
  FacetHit first(const Vec3& from, const Vec3& to, std::span<const std::uint32_t> passed);

  // Returns true if the limit ended a search; its answer is then not to be trusted.
  [[nodiscard]] bool is_cut() const { return left_ == 0; }
  // Returns how many triangles may still be measured.
  [[nodiscard]] std::size_t left() const { return left_; }

 private:
  const MeshView& mesh_;
  Sides sides_;
  std::size_t left_;
};

}  // namespace tactus::rendering
