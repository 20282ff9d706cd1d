// Tests whether triangles come near a straight segment, four triangles at a time.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "rendering/geometry/floats.h"
#include "rendering/geometry/mesh.h"

namespace tactus::rendering {

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
  struct Four {
    std::uint32_t near;  // which
    FourVectors normal;
    Floats offset;
  };

  // Returns the bounds of four triangles from `first` on; the last one is repeated if there are
  // fewer.
  [[nodiscard]] Four bounds(const MeshView& mesh, std::uint32_t first, std::uint32_t last) const;
  [[nodiscard]] FourVectors from_start(const FourVectors& p) const;

  FourVectors start_;       // to the nearest float
  FourVectors start_rest_;  // what that leaves of it
  FourVectors segment_;
  FourVectors segment_by_squared_;  // over its squared length
  float reach_ = 0.0F;
};

}  // namespace tactus::rendering
