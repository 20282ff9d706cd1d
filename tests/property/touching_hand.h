// A hand that strokes and presses a shape, and keeps off its medial axis.
#pragma once

#include <cstdint>
#include <random>

#include "tests/property/closed_form.h"

namespace tactus::testing {

// It goes straight to random places about the shape and below its surface, at random speeds, and
// slides along the surface where that is in the way: by some share of the reach below it, so that
// the nearest place of the surface is never in doubt. Sharp edges have no reach. There it keeps
// above the surface, and goes deep only where it can no more cross the edge in one tick.
class TouchingHand {
 public:
  // `most_step_m` is the longest step in a tick.
  TouchingHand(const TouchedShape& shape, double most_step_m, std::uint64_t seed);

  // The deepest below the surface, m, and the most of the reach.
  static constexpr double kDeepest_m = 0.0031;
  static constexpr double kMostOfReach = 0.6;

  // Returns the tool's place in the next tick, world frame. In the first it is free.
  Vec3 next();

 private:
  void move();
  [[nodiscard]] Vec3 any_place();
  void choose_target();
  // Returns how deep the tool may be below the place that is nearest to p_W.
  [[nodiscard]] double allowed_depth_m(const Vec3& p_W) const;
  // Returns true in the tip of a hollow cone, where a formula is singular and more triangles meet
  // than are kept.
  [[nodiscard]] bool is_in_tip(const Vec3& p_W) const;

  const TouchedShape& shape_;
  double most_step_m_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
  Vec3 tool_W_ = Vec3::Zero();
  Vec3 target_W_ = Vec3::Zero();
  double step_m_ = 0.0;
  int ticks_left_ = 0;
};

}  // namespace tactus::testing
