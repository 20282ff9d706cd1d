#include "rendering/contact/crease_walls.h"

#include <algorithm>
#include <cmath>

#include "rendering/contact/implicit_planes.h"
#include "rendering/contact/implicit_sample.h"

namespace tactus::rendering {

void CreaseWalls::add(const Vec3& offset_O) {
  offsets_O_[1] = offsets_O_[0];
  offsets_O_[0] = offset_O;
  count_ = static_cast<std::uint8_t>(std::min(count_ + 1, 2));
}

void CreaseWalls::add_planes(ImplicitField& field, const ImplicitSample& ground,
                             ImplicitPlanes& planes) {
  // The square of the least angle between a wall and the ground, rad.
  constexpr double kLeastTurn = 1e-4;
  // The wall's point may be off the wall by this part of its distance from the proxy.
  constexpr double kMostHeight = 0.3;
  const ImplicitSurface& surface = field.surface();
  const auto has_ended = [&](const Vec3& offset_O) {
    const ImplicitSample wall = sample(field, ground.point + offset_O);
    // A wall that the proxy is behind is the far side of a thin one.
    const double distance = -wall.normal.dot(offset_O);
    const double height = std::abs(wall.height);
    const bool stands = wall.steepness > 0.0 && distance > 0.0 &&
                        height <= kMostHeight * distance &&
                        height * surface.scale_m <= kImplicitReach_m &&
                        (wall.normal - ground.normal).squaredNorm() > kLeastTurn;
    if (stands) {
      planes.add(tangent_plane(surface, wall));
    }
    return !stands;
  };
  auto* const end = offsets_O_.begin() + count_;
  auto* const kept_end = std::remove_if(offsets_O_.begin(), end, has_ended);
  count_ = static_cast<std::uint8_t>(kept_end - offsets_O_.begin());
}

}  // namespace tactus::rendering
