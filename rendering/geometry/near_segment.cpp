// A triangle lies behind every plane that its three corners lie behind. The plane used here is
// normal to the gap between the triangle's middle and the nearest point of the segment, and a
// segment is nearest to a plane at one of its ends.
//
// Corners count from the segment's start, which is subtracted in two parts, so that the error of
// the result is relative to the result. A dot product of three is then wrong by less than eight
// roundings of the lengths involved, and kSegmentRounding is sixteen.
#include "rendering/geometry/near_segment.h"

#include <algorithm>

namespace tactus::rendering {
namespace {

// The rounding of a result, as a share of the lengths involved.
constexpr float kSegmentRounding = 1e-6F;
// A shorter gap may have a square of zero, and its direction is not used.
constexpr float kLeastSquaredGap = 1e-30F;

// Returns one corner of each of four triangles.
FourVectors corners(const MeshView& mesh, const std::array<const TriangleIndices*, 4>& triangles,
                    std::size_t corner) {
  return four(mesh.vertices[(*triangles[0])[corner]], mesh.vertices[(*triangles[1])[corner]],
              mesh.vertices[(*triangles[2])[corner]], mesh.vertices[(*triangles[3])[corner]]);
}

// Returns the largest component of each vector.
Floats largest(const FourVectors& v) {
  return most(most(magnitude(v.x), magnitude(v.y)), magnitude(v.z));
}

}  // namespace

NearSegment::NearSegment(const Vec3& start, const Vec3& segment, double reach)
    : start_(four(start)),
      start_rest_(four(start - to_vec3(to_float3(start)))),
      segment_(four(segment)),
      segment_by_squared_(four(segment.squaredNorm() > 0.0
                                   ? Vec3{segment * (1.0 / segment.squaredNorm())}
                                   : Vec3{Vec3::Zero()})) {
  const auto length = static_cast<float>(segment.norm());
  reach_ = static_cast<float>(reach) * (1.0F + kSegmentRounding) + kSegmentRounding * length;
}

FourVectors NearSegment::from_start(const FourVectors& p) const {
  return {(p.x - start_.x) - start_rest_.x, (p.y - start_.y) - start_rest_.y,
          (p.z - start_.z) - start_rest_.z};
}

NearSegment::Four NearSegment::bounds(const MeshView& mesh, std::uint32_t first,
                                      std::uint32_t last) const {
  const std::array<const TriangleIndices*, 4> triangles{
      &mesh.triangles[first], &mesh.triangles[std::min(first + 1, last)],
      &mesh.triangles[std::min(first + 2, last)], &mesh.triangles[std::min(first + 3, last)]};
  const FourVectors a = from_start(corners(mesh, triangles, 0));
  const FourVectors b = from_start(corners(mesh, triangles, 1));
  const FourVectors c = from_start(corners(mesh, triangles, 2));
  constexpr float kThird = 1.0F / 3.0F;
  const FourVectors middle{kThird * (a.x + b.x + c.x), kThird * (a.y + b.y + c.y),
                           kThird * (a.z + b.z + c.z)};
  // The point of the segment nearest to each triangle's middle, as a share of the length.
  const Floats part = least(most(dot(middle, segment_by_squared_), all(0.0F)), all(1.0F));
  const FourVectors offset{part * segment_.x - middle.x, part * segment_.y - middle.y,
                           part * segment_.z - middle.z};
  const Floats squared = dot(offset, offset);
  // `offset` points from the triangle's middle to that point. `behind` is the height of the
  // triangle's highest corner along it, and `distance` that of the segment's lower end over it,
  // both times |offset|: comparing squares needs no root.
  const Floats behind = most(most(dot(offset, a), dot(offset, b)), dot(offset, c));
  const Floats distance = least(dot(offset, segment_), all(0.0F)) - behind;
  const Floats size = most(most(largest(a), largest(b)), largest(c));
  const Floats rounding = kSegmentRounding * size;
  const Floats reach = reach_ + rounding;
  const Integers directed = squared > kLeastSquaredGap;
  const Integers far = (distance > 0.0F) & (distance * distance > reach * reach * squared);
  Four four{.near = which(~(far & directed))};
  // The plane in front of the triangle, for those that are near: unit normal and height.
  if (four.near != 0) {
    const Floats over = directed ? (1.0F - kSegmentRounding) / root(squared) : all(0.0F);
    four.normal = {over * offset.x, over * offset.y, over * offset.z};
    four.offset = over * behind + rounding;
  }
  return four;
}

}  // namespace tactus::rendering
