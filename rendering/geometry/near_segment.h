// Tests whether triangles come near a straight segment, four triangles at a time. Gathering tests
// the capsule's axis, and the object sweep the rest of its line.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "rendering/geometry/floats.h"
#include "rendering/geometry/mesh.h"

namespace tactus::rendering {

// One segment, prepared in floats. near_segment.cpp derives the test and its rounding.
class NearSegment {
 public:
  // The segment goes from `start` to start + segment, which may be zero; m. `reach` is the distance
  // (m) that counts as near.
  NearSegment(const Vec3& start, const Vec3& segment, double reach);

  // A plane in front of a triangle: from p it is at least normal . (p - start) - offset away. The
  // normal is no longer than 1.
  struct Bound {
    Float3 normal;
    float offset = 0.0F;  // m
  };

  // Calls found(index, bound) for every one of `count` triangles from `first` on that may come
  // within reach of the segment. Triangles that only rounding could hide are included.
  template <class Found>
  void find(const MeshView& mesh, std::uint32_t first, std::uint32_t count, Found&& found) const {
    const std::uint32_t end = first + count;
    for (; first < end; first += 4) {
      const Four four = bounds(mesh, first, end - 1);
      for (std::uint32_t near = four.near; near != 0; near &= near - 1) {
        const std::uint32_t k = lowest(near);
        if (first + k < end) {
          found(first + k, Bound{.normal = {four.normal.x[k], four.normal.y[k], four.normal.z[k]},
                                 .offset = four.offset[k]});
        }
      }
    }
  }

 private:
  // The answers for four triangles: `near` has a bit for each that may be near.
  struct Four {
    std::uint32_t near;  // which
    FourVectors normal;
    Floats offset;
  };

  // Returns the bounds of four triangles from `first` on; the last one is repeated if there are
  // fewer.
  [[nodiscard]] Four bounds(const MeshView& mesh, std::uint32_t first, std::uint32_t last) const;
  // Returns points relative to the segment's start, with an error relative to the result.
  [[nodiscard]] FourVectors from_start(const FourVectors& p) const;

  // The start, to the nearest float, and what that leaves of it.
  FourVectors start_;
  FourVectors start_rest_;  // what that leaves of it
  FourVectors segment_;
  // The segment over its squared length: its dot product with a point is the point's share of the
  // length.
  FourVectors segment_by_squared_;
  float reach_ = 0.0F;
};

}  // namespace tactus::rendering
