// Ends a tick of a proxy that only swings between the walls of an implicit surface.
#pragma once

#include <cmath>
#include <limits>

#include "rendering/contact/implicit_sample.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// A proxy can swing in a pit or in a crease of singular points, where rounding decides each move.
// This class counts the sub-goals in contact since the distance to the tool last fell by a
// nanometre. After four of them the tick ends, at the place nearest to the tool where the proxy was
// at its rest height.
class ImplicitStall {
 public:
  // Notes the proxy's place in one sub-goal, its height above the surface (m) and its distance from
  // the tool, from which friction makes it lag (m). Returns true if the tick must end. Out of
  // contact it starts over.
  bool note(const Vec3& p_O, double height_m, double distance_m) {
    if (height_m > kImplicitReach_m) {
      nearest_m_ = std::numeric_limits<double>::infinity();
      stalled_ = 0;
      return false;
    }
    stalled_ = distance_m < nearest_m_ - kGain_m ? 0 : stalled_ + 1;
    if (distance_m < nearest_m_ && height_m >= 0.5 * kImplicitRest_m) {
      nearest_m_ = distance_m;
      best_O_ = p_O;
    }
    return stalled_ >= kPatience;
  }

  // Returns true if the last sub-goal came no nearer and a better place is known.
  [[nodiscard]] bool has_swung() const { return stalled_ > 0 && std::isfinite(nearest_m_); }
  // Returns the place nearest to the tool; object frame.
  [[nodiscard]] const Vec3& best_O() const { return best_O_; }

 private:
  static constexpr int kPatience = 4;
  static constexpr double kGain_m = 1e-9;

  // The least distance from the lagging tool in this contact, the place where that was, and the
  // sub-goals since it last fell.
  double nearest_m_ = std::numeric_limits<double>::infinity();
  Vec3 best_O_ = Vec3::Zero();
  int stalled_ = 0;
};

}  // namespace tactus::rendering
