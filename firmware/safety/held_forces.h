// Keeps the forces that went out in the last ticks and computes the one that acts on the handle
// now. The device answers a sample after SafetyConfig::device_delay_s, which need not be a whole
// number of ticks. One thread; real time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The force of one tick and its parts, N, in the world frame.
struct HeldForce {
  // The whole force that went out.
  Vec3 all_W = Vec3::Zero();
  // The part of it that comes from surfaces and effects.
  Vec3 rendered_W = Vec3::Zero();
  // The part of rendered_W that comes from effects.
  Vec3 effect_W = Vec3::Zero();
};

// The forces of the last kMost + 1 ticks.
class HeldForces {
 public:
  // The longest delay in ticks. A longer one is cut to it: 15 ms at 1 kHz.
  static constexpr std::size_t kMost = 15;

  // Sets the delay in ticks, and all forces to zero.
  void configure(double delay_ticks) {
    const double ticks = std::clamp(delay_ticks, 0.0, static_cast<double>(kMost));
    whole_ = std::min(static_cast<std::size_t>(ticks), kMost - 1);
    share_ = ticks - static_cast<double>(whole_);
    restart();
  }

  // Sets all forces to zero.
  void restart();

  // Adds the force that goes out in this tick.
  void push(const HeldForce& force) {
    newest_ = (newest_ + 1) % ring_.size();
    ring_[newest_] = force;
  }

  // Returns the force that went out last.
  [[nodiscard]] const HeldForce& newest() const { return ring_[newest_]; }

  // Returns the force that acts until the next push: the linear interpolation between the two
  // forces on both sides of the delay.
  [[nodiscard]] HeldForce acting() const;

  // Returns the mean of acting() over `ticks` ticks in which the newest force is held. Pushes the
  // newest force again for each further tick.
  HeldForce acting_over(std::size_t ticks);

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  // Returns the force of that many ticks ago.
  [[nodiscard]] const HeldForce& back(std::size_t ticks) const {
    return ring_[(newest_ + ring_.size() - ticks) % ring_.size()];
  }

  std::array<HeldForce, kMost + 1> ring_{};
  std::size_t newest_ = 0;
  // The delay: whole ticks, and the share of one more.
  std::size_t whole_ = 0;
  double share_ = 0.0;
};

}  // namespace tactus::firmware
