// The objects that the shared proxy does not feel: those that it overlapped when it began, came out
// of, or was pinched by. Each comes back once no surface of it is within the proxy's reach.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/contact/sphere_sweep.h"
#include "rendering/limits.h"
#include "rendering/state/state_archive.h"
#include "rendering/world/scene_objects.h"

namespace tactus::rendering {

class LeftOut {
 public:
  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] bool has(std::uint32_t object) const {
    return count_ > 0 && (bits_[object / kBits] >> (object % kBits) & 1U) != 0;
  }

  // An object below kMaxObjects. True if it was felt before.
  bool add(std::uint32_t object);

  // Adds what has a surface nearer to p_W than the inner contact margin by more than `slack_m`;
  // world frame, m. Where that takes more than kMaxCarryBudget an object is added too. True if one
  // was felt before.
  bool add_overlapped(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p_W,
                      double slack_m);

  // Takes back what is farther from p_W than the reach of the contact margin. True if any was. Work
  // bounded by kMaxCarryBudget; what is not known then stays out.
  bool take_back(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p_W);

  // What it remembers, to bytes or back.
  void transfer(StateArchive& archive);

 private:
  static constexpr std::size_t kBits = 64;
  std::array<std::uint64_t, kMaxObjects / kBits> bits_{};
  std::uint32_t count_ = 0;
};

}  // namespace tactus::rendering
