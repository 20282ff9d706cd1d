// The objects that the shared proxy ignores: it overlapped them when it was placed, came out of
// them from behind, or was pinched by them. An object counts again once none of its surfaces is
// within the proxy's reach.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/contact/sphere_sweep.h"
#include "rendering/limits.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// A set of object numbers.
class LeftOut {
 public:
  // Returns true if any object is left out.
  [[nodiscard]] bool any() const { return count_ > 0; }
  // Returns true if the object is left out. The common case, in which none is, costs one
  // comparison.
  [[nodiscard]] bool has(std::uint32_t object) const {
    return count_ > 0 && (bits_[object / kBits] >> (object % kBits) & 1U) != 0;
  }

  // Adds an object, `object` < kMaxObjects. Returns true if it was not left out before.
  bool add(std::uint32_t object);

  // Adds every object with a surface that is nearer to p_W than the contact margin's `inner_m` by
  // more than `slack_m` (world frame, m). An object is added too if the test would cost more than
  // kMaxCarryBudget. Returns true if an object was added.
  bool add_overlapped(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p_W,
                      double slack_m);

  // Removes the objects that are farther from p_W than the contact margin's reach, within
  // kMaxCarryBudget; untested objects stay. Returns true if one was removed.
  bool take_back(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p_W);

  // Saves the state of a scene with so many objects to the archive, or restores it. The bytes do
  // not depend on kMaxObjects.
  void transfer(StateArchive& archive, std::size_t objects);

 private:
  static constexpr std::size_t kBits = 64;
  // A bit for each object, and the number of the set ones.
  std::array<std::uint64_t, (kMaxObjects + kBits - 1) / kBits> bits_{};
  std::uint32_t count_ = 0;
};

}  // namespace tactus::rendering
