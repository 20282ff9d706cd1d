// Four vertices are twelve numbers, one after the other: six pairs, which are computed in double as
// one vertex at a time would be.
#include "rendering/objects/vertex_wave.h"

#include <bit>
#include <cstdint>
#include <memory>

#include "rendering/geometry/floats.h"
#include "rendering/geometry/pair.h"

namespace tactus::rendering {
namespace {

// Returns the heights of two vertices over their places at rest, m. `turned` has the cosine and the
// sine of the time's angle.
Pair heights_of(const SineCosine* angles, Pair turned, Pair wave_m) {
  const SineCosine* const pairs = std::assume_aligned<alignof(Pair)>(angles);
  // The two products of wave_at(), for each vertex.
  const Pair first = std::bit_cast<Pair>(pairs[0]) * turned;
  const Pair second = std::bit_cast<Pair>(pairs[1]) * turned;
  return wave_m * (__builtin_shufflevector(first, second, 1, 3) -
                   __builtin_shufflevector(first, second, 0, 2));
}

// Returns the pair of numbers at `rest`, moved by the heights along `normal`. Both are aligned.
Pair moved(const double* rest, Pair heights, const double* normal) {
  return pair_at(std::assume_aligned<alignof(Pair)>(rest)) +
         heights * pair_at(std::assume_aligned<alignof(Pair)>(normal));
}

// Returns true if a vertex begins at a multiple of a pair's size. Every other one does.
bool is_aligned(const Vec3& vertex) {
  return reinterpret_cast<std::uintptr_t>(vertex.data()) % alignof(Pair) == 0;
}

}  // namespace

WaveVertices WavePool::start(const Motion& motion, std::size_t first,
                             std::span<const Float3> vertices,
                             std::span<const Float3> vertex_normals) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    rest[first + i] = to_vec3(vertices[i]);
    normals[first + i] = to_vec3(vertex_normals[i]);
    angles[first + i] = wave_angle(motion, rest[first + i]);
  }
  return WaveVertices{.rest = rest, .normals = normals, .angles = angles}.part(first,
                                                                               vertices.size());
}

void wave(const Motion& motion, const SineCosine& of_time, const WaveVertices& vertices,
          std::span<Float3> to) {
  // Copies, which the stores cannot change.
  const auto [rest, normals, angles] = vertices;
  const Pair turned{of_time.cosine, of_time.sine};
  const Pair wave_m = both(motion.wave_m);
  const auto move_one = [&](std::size_t k) {
    to[k] = to_float3(rest[k] + wave_at(motion, angles[k], of_time) * normals[k]);
  };
  std::size_t i = 0;
  if (!to.empty() && !is_aligned(rest.front())) {
    move_one(i++);
  }
  for (; i + 4 <= to.size(); i += 4) {
    const Pair ab = heights_of(&angles[i], turned, wave_m);
    const Pair cd = heights_of(&angles[i + 2], turned, wave_m);
    const Pair aa = both(ab[0]);
    const Pair bb = both(ab[1]);
    const Pair cc = both(cd[0]);
    const Pair dd = both(cd[1]);
    const double* const from = rest[i].data();
    const double* const along = normals[i].data();
    float* const place = &to[i].x;
    store(rounded(moved(from, aa, along), moved(from + 2, ab, along + 2)), place);
    store(rounded(moved(from + 4, bb, along + 4), moved(from + 6, cc, along + 6)), place + 4);
    store(rounded(moved(from + 8, cd, along + 8), moved(from + 10, dd, along + 10)), place + 8);
  }
  for (; i < to.size(); ++i) {
    move_one(i);
  }
}

}  // namespace tactus::rendering
