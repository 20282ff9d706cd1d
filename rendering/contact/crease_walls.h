// Remembers the walls of the crease in which a proxy on an implicit surface is.
#pragma once

#include <array>
#include <cstdint>

#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

class ImplicitField;
class ImplicitPlanes;
struct ImplicitSample;

// At most two walls beside the ground under the proxy: points near it on the walls that have
// blocked it. A proxy that knows them at once does not have to find them again in every move, and
// friction sees all that hold it.
class CreaseWalls {
 public:
  // Removes all walls.
  void clear() { count_ = 0; }

  // Adds a wall, instead of the oldest if there are two. `offset_O` leads from the proxy to the
  // point that blocked it; object frame.
  void add(const Vec3& offset_O);

  // Adds the tangent planes of the walls, as they are beside a proxy in contact. `ground` is the
  // sample at the proxy. A wall that is no more than the ground itself, or that ends, is forgotten.
  void add_planes(ImplicitField& field, const ImplicitSample& ground, ImplicitPlanes& planes);

  // Saves the walls to the archive, or restores them.
  void transfer(StateArchive& archive);

 private:
  std::array<Vec3, 2> offsets_O_{Vec3::Zero(), Vec3::Zero()};
  std::uint8_t count_ = 0;
};

}  // namespace tactus::rendering
