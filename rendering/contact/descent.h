// Ends the moves of a tick that bring the proxy no nearer to its goal.
#pragma once

#include <limits>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Within the contact margin a move may lift the proxy to the rest height of a plane, and so lead
// farther from the goal by a fraction of a micrometre. Such moves can follow each other in a cycle.
// This class proves that a tick ends: the least distance d so far is a potential. Every kPatience
// moves it falls by kGain_m, or the tick ends; so a tick whose first distance is d makes at most
// kPatience * (1 + d / kGain_m) moves. (The tick's budget ends it long before that.)
class Descent {
 public:
  // Notes the distance of a resting place `p_W` (world frame) from the goal, m. Returns false if
  // the tick must end, at best_W(), because the last kPatience places were not nearer.
  bool note(double distance_m, const Vec3& p_W) {
    if (distance_m < least_m_ - kGain_m) {
      least_m_ = distance_m;
      best_W_ = p_W;
      since_gain_ = 0;
      return true;
    }
    return ++since_gain_ < kPatience;
  }

  // Returns true if some places in a row were not nearer. The moves may then go round in a cycle,
  // which the planes of all its places together end.
  [[nodiscard]] bool is_stalling() const { return since_gain_ >= kSuspicion; }
  // Returns the place nearest to the goal; world frame, m.
  [[nodiscard]] const Vec3& best_W() const { return best_W_; }

 private:
  // The least gain that counts, m. At a distance d from the goal a gain g is a move of about
  // sqrt(2 d g) along the surface: 0.4 um at 10 mm.
  static constexpr double kGain_m = 1e-11;
  static constexpr int kSuspicion = 4;
  static constexpr int kPatience = 32;

  double least_m_ = std::numeric_limits<double>::infinity();
  Vec3 best_W_ = Vec3::Zero();
  int since_gain_ = 0;
};

}  // namespace tactus::rendering
