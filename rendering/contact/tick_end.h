// Ends a tick whose proxy has settled, or whose moves bring the proxy no nearer to its goal.
#pragma once

#include <cstdint>

#include "rendering/contact/descent.h"
#include "rendering/contact/moving_proxy.h"
#include "rendering/contact/sub_goal.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// One object judges the sub-goals of one tick. All positions are in the world frame, m.
class TickEnd {
 public:
  // Begins with the proxy's state before the tick, whose goal is h_W.
  TickEnd(const ProxyState& state, const Vec3& h_W)
      : start_W_(state.p_W),
        has_rest_(state.is_settled && (h_W - state.settled_for_W).norm() <= kGoalAtRest_m) {}

  // The continuation after a sub-goal is chosen.
  enum class Verdict : std::uint8_t {
    go_on,      // the proxy moves to the sub-goal
    gone_back,  // the proxy was put back to a place of this tick: find its contact there
    settled,    // the tick ends here
  };
  // Judges a sub-goal of the proxy. A proxy whose moves bring it no nearer to the goal returns to
  // the nearest place. Under a goal at rest, so does one that would settle no nearer than where it
  // had settled before. The path back is free: it is the path that led away.
  Verdict judge(const SubGoal& goal, const Vec3& h_W, const MovingProxy& proxy);

  // Remembers that the proxy is where the goal h_W wants it. A goal at rest stays the one for which
  // the proxy came there.
  void settle(const Vec3& h_W, ProxyState& state) const {
    state.is_settled = true;
    if (!has_rest_ || state.p_W != start_W_) {
      state.settled_for_W = h_W;
    }
  }

  // Returns true once the proxy was put back: only its contact is still to be found.
  [[nodiscard]] bool has_gone_back() const { return has_gone_back_; }

  // Returns true if the last moves were not nearer to the goal (Descent::is_stalling).
  [[nodiscard]] bool is_stalling() const { return descent_.is_stalling(); }

 private:
  // A goal that has moved by less than this since the proxy settled is at rest, m. A proxy that
  // would then settle no nearer to it by kRestGain_m stays where it is: the difference is rounding.
  static constexpr double kGoalAtRest_m = 1e-9;
  static constexpr double kRestGain_m = 1e-11;

  Descent descent_;
  // The proxy at the start of the tick, and whether it had settled there for the goal of this tick.
  Vec3 start_W_;
  bool has_rest_;
  bool has_gone_back_ = false;
};

// The moves compare places at their rest height: below it, where a sweep may end, every place is
// nearer. Inline, because every sub-goal takes this path.
inline TickEnd::Verdict TickEnd::judge(const SubGoal& goal, const Vec3& h_W,
                                       const MovingProxy& proxy) {
  Vec3& p = proxy.state.p_W;
  if (!has_gone_back_ && !goal.settled) {
    const Vec3 at_rest_W = proxy.planes.empty() ? p : proxy.planes.resting_position(p);
    if (descent_.note((goal.tool - at_rest_W).norm(), p)) {
      return Verdict::go_on;
    }
    p = descent_.best_W();
  } else if (!has_gone_back_ && has_rest_ && p != start_W_ &&
             (goal.tool - p).norm() >= (goal.tool - start_W_).norm() - kRestGain_m) {
    p = start_W_;
  } else {
    settle(h_W, proxy.state);
    return Verdict::settled;
  }
  has_gone_back_ = true;
  return Verdict::gone_back;
}

}  // namespace tactus::rendering
