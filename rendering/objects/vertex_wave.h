// The waves of a mesh that deforms: moves its vertices along their normals, four at a time. Movers
// calls it in every tick.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "rendering/geometry/portable_math.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/objects/motion.h"

namespace tactus::rendering {

// The vertices of a wave at rest: their places and normals, and the angles that wave_angle() gives
// their places, which are aligned as in WavePool. The spans are equally long; frame O, m.
struct WaveVertices {
  std::span<const Vec3> rest;
  std::span<const Vec3> normals;
  std::span<const SineCosine> angles;

  // Returns `count` of them from `first` on.
  [[nodiscard]] WaveVertices part(std::size_t first, std::size_t count) const {
    return {.rest = rest.subspan(first, count),
            .normals = normals.subspan(first, count),
            .angles = angles.subspan(first, count)};
  }
};

// Memory for the waves of a scene. A vertex of the same number is aligned alike in each array.
struct WavePool {
  alignas(16) std::array<Vec3, kMaxDeformableVertices> rest;
  alignas(16) std::array<Vec3, kMaxDeformableVertices> normals;
  alignas(16) std::array<SineCosine, kMaxDeformableVertices> angles;

  // Sets the vertices from `first` on to those of a mesh at rest in its motion's wave, and returns
  // them. There must be room.
  WaveVertices start(const Motion& motion, std::size_t first, std::span<const Float3> vertices,
                     std::span<const Float3> vertex_normals);
};

// Writes the places that the vertices have in the wave: to_float3(rest + wave_at(...) * normal),
// bit for bit. `to` is as long as the spans.
void wave(const Motion& motion, const SineCosine& of_time, const WaveVertices& vertices,
          std::span<Float3> to);

}  // namespace tactus::rendering
