// Holds a proxy on an implicit surface back by friction.
#pragma once

#include "rendering/contact/implicit_planes.h"
#include "rendering/contact/implicit_tracking.h"
#include "rendering/geometry/vector.h"
#include "rendering/material/material.h"
#include "rendering/surface/implicit_surface.h"

namespace tactus::rendering {

// The end of the proxy's next move.
struct ImplicitGoal {
  Vec3 point = Vec3::Zero();  // object frame
  // The point to which the tool pulls the proxy, from which the friction circle draws the goal
  // back; object frame.
  Vec3 pulled_to = Vec3::Zero();
  // True if there is no move: the proxy is where the tool and friction want it.
  bool settled = false;
};

// One object holds the proxy in the sub-goals of one tick.
class ImplicitFriction {
 public:
  explicit ImplicitFriction(const Material& material) : material_(material) {}

  // Returns the goal that friction leaves to the proxy, and updates its friction state. `push` is
  // that of the planes against the tool h (object frame).
  ImplicitGoal hold(const ImplicitPush& push, const ImplicitPlanes& planes, const Vec3& h,
                    const ImplicitSurface& surface, ImplicitProxyState& state);

  // Remembers the friction before a goal is chosen, and returns to it if the choice is not taken.
  void begin_choice(const ImplicitProxyState& state) {
    before_ = {state.friction, state.model, slipped_, lag_O_};
  }
  void take_back(ImplicitProxyState& state) {
    state.friction = before_.friction;
    state.model = before_.model;
    slipped_ = before_.slipped;
    lag_O_ = before_.lag_O;
  }

  // Returns the friction state of the touch: free on a surface without friction.
  [[nodiscard]] FrictionState seen(const ImplicitProxyState& state) const {
    return has_friction(material_.friction) ? state.friction : FrictionState::free;
  }
  // Returns the lag of the tool that a friction model asks for, object frame; zero otherwise.
  [[nodiscard]] const Vec3& lag_O() const { return lag_O_; }

 private:
  ImplicitGoal stay_in_cone(const ImplicitPush& push, const ImplicitSurface& surface,
                            ImplicitProxyState& state);
  ImplicitGoal lag_behind(const ImplicitPush& push, const ImplicitPlanes& planes, const Vec3& h,
                          const ImplicitSurface& surface, ImplicitProxyState& state);

  const Material& material_;
  // True once the proxy slipped in this tick: it then slips in the rest of it.
  bool slipped_ = false;
  Vec3 lag_O_ = Vec3::Zero();
  // The friction at the last begin_choice().
  struct Before {
    FrictionState friction = FrictionState::free;
    SurfaceFriction model;
    bool slipped = false;
    Vec3 lag_O = Vec3::Zero();
  };
  Before before_;
};

}  // namespace tactus::rendering
