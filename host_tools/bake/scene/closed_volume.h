// Measures the volume of closed meshes and finds those that are inside out. The baker and
// `tactus inspect` use it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "rendering/scene/mesh_check.h"

namespace tactus::host {

// The findings on a closed mesh.
struct ClosedVolume {
  // The sum over all parts, m^3: positive if faces are counter-clockwise as seen from outside.
  double volume_m3 = 0.0;
  // Connected parts, and those of them that are inside out: their volume is negative, and they are
  // no hollow within another part.
  std::size_t parts = 0;
  std::size_t inside_out = 0;
  // A vertex of the largest part that is inside out, world frame, m.
  Vec3 place_W = Vec3::Zero();
};

// Returns the findings; nothing if the mesh is not closed, that is, if an edge is open,
// non-manifold or wound inconsistently. The time is proportional to the mesh, and to the mesh for
// each part of negative volume.
std::optional<ClosedVolume> closed_volume(const rendering::BakedMeshView& mesh);

// Returns a sentence for the user if a part is inside out, else nothing. It ends with `remedy` if
// the whole mesh is to be turned around.
std::optional<std::string> inside_out_warning(const std::optional<ClosedVolume>& volume,
                                              std::string_view remedy);

}  // namespace tactus::host
