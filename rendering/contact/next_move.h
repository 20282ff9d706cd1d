// Finds the proxy's next straight move: the third to the fifth step of a sub-goal
// (proxy_tick.cpp).
#pragma once

#include "rendering/contact/candidate_sweep.h"
#include "rendering/contact/constraint_memory.h"
#include "rendering/contact/moving_proxy.h"
#include "rendering/contact/plane_collection.h"
#include "rendering/contact/sub_goal.h"

namespace tactus::rendering {

// A sub-goal and the sweep toward it.
struct NextMove {
  SubGoal goal;
  SweepResult sweep;  // toward the goal, unless that is settled
};

// One object finds the moves of one tick, and keeps what one leaves to the next.
class MoveFinder {
 public:
  // Returns the next move. `collector` adds the planes that it needs at the proxy. `is_stalling`
  // says that the moves may go round in a cycle (Descent::is_stalling). `watch` sees the choices
  // and the sweeps as steps of the tick.
  template <class Watch>
  NextMove find(const ProxyMove& tick, const MovingProxy& proxy, PlaneCollector& collector,
                bool is_stalling, Watch watch);

  // Takes note that the proxy moves from p (world frame, m) to `goal`. The planes of `rest` held
  // it; those of a lengthened move are left behind and not remembered.
  void leave(const Vec3& p, const SubGoal& goal, const ProxyRest& rest) {
    constraints_.leave(p, rest, goal.lengthened ? std::size_t{0} : rest.plane_count);
    sub_goals_.leave(p, goal, rest);
  }

  // Forgets the constraints. Call it when the candidates get new numbers.
  void forget_candidates() { constraints_.clear(); }

  // Returns the constraints met in this tick.
  [[nodiscard]] const ConstraintMemory& constraints() const { return constraints_; }

 private:
  ConstraintMemory constraints_;
  SubGoalChooser sub_goals_;
};

}  // namespace tactus::rendering
