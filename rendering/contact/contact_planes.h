// The contact planes at one position of the proxy. They bound its centre in one sub-goal.
// PlaneCollector fills them; active_constraints.h projects the tool on them; friction_hold.h asks
// them for the rest height.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/contact/proxy_rest.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/limits.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// A sphere that overlaps a surface by at most this, by rounding or by a deformation, is pushed out
// in one tick. An object with a greater overlap is left out until the sphere is clear of it.
inline constexpr double kMaxPushOut_m = 20e-6;

// A shorter move counts as none: its force is a micronewton at 1000 N/m.
inline constexpr double kSettled_m = 1e-9;

// At most kMaxContactPlanes planes, in the order in which they were added.
class ContactPlanes {
 public:
  // Removes all planes.
  void clear() {
    count_ = 0;
    is_above_first_ = false;
  }

  // Returns the place of a new plane, which the caller fills; nullptr if an equal plane that bounds
  // the proxy as far is there. Beyond kMaxContactPlanes the planes with the nearest surfaces are
  // kept, and `flags` gets kTouchPlanesOverflow: then the place is that of the farthest surface, or
  // nullptr if `distance_m`, the new one's, is as far.
  ContactPlane* add(const Plane& plane, double distance_m, std::uint32_t& flags) {
    if (is_there(plane)) {
      return nullptr;
    }
    if (count_ == kMaxContactPlanes) {
      flags |= kTouchPlanesOverflow;
      return farthest_beyond(distance_m);
    }
    return &contacts_[count_++];
  }

  // Says that the proxy is above the rest height of the first plane, so that it comes down to it.
  void set_above_first(bool is_above) { is_above_first_ = is_above; }

  // Return the planes.
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::span<const ContactPlane> all() const { return {contacts_.data(), count_}; }
  [[nodiscard]] const ContactPlane& operator[](std::size_t i) const { return contacts_[i]; }

  // Returns true if candidate `number` gave one of the planes.
  [[nodiscard]] bool has(std::size_t number) const;

  // Returns true if `p` is on the positive side of all planes, to rounding.
  [[nodiscard]] bool allow(const Vec3& p) const;

  // Returns the point nearest to the tool `h` on the positive side of all planes; `p` is the
  // proxy (world frame, m). It is not `feasible` if surfaces push against each other and leave the
  // proxy no place nearer to the tool.
  PlaneProjection project(const Vec3& p, const Vec3& h);

  // Returns the proxy's position at the rest height of the planes, at most kMaxPushOut_m from `p`.
  // A sweep ends a little below that height, where friction alone would leave the proxy and the
  // next seam would block it; after a move past the end of a face the proxy is a little above.
  Vec3 resting_position(const Vec3& p);

  // Saves the planes to the archive, or restores them. If not `are_kept`, there are none.
  void transfer(StateArchive& archive, const SceneObjects& scene, bool are_kept);

 private:
  // Returns true if an equal plane that bounds the proxy as far is there: triangles that share the
  // nearest edge or vertex give the same plane. Normals that differ by less than 1e-10 rad are the
  // same to rounding.
  [[nodiscard]] bool is_there(const Plane& plane) const {
    constexpr double kSameNormal = 1e-20;
    return std::ranges::any_of(all(), [&](const ContactPlane& c) {
      return (c.plane.normal - plane.normal).squaredNorm() < kSameNormal &&
             c.plane.offset >= plane.offset;
    });
  }
  // Returns the plane with the farthest surface if that is beyond `distance_m`, or nullptr. The
  // nearest surfaces are kept, since they block the shortest moves.
  ContactPlane* farthest_beyond(double distance_m);

  // The planes with the surfaces that give them, the first `count_`.
  std::array<ContactPlane, kMaxContactPlanes> contacts_;
  std::size_t count_ = 0;
  // True if the proxy is above the rest height of the first plane (set_above_first).
  bool is_above_first_ = false;
  // The same planes without their surfaces, as a projection takes them.
  std::array<Plane, kMaxContactPlanes> planes_;
};

}  // namespace tactus::rendering
