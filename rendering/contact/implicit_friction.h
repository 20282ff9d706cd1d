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
  // True if there is no move: the proxy is where the tool and friction want it.
  bool settled = false;
};

// One object holds the proxy in the sub-goals of one tick.
class ImplicitFriction {
 public:
  explicit ImplicitFriction(const Material& material) : material_(material) {}

  // Returns the goal that friction leaves to the proxy, and updates its friction state.
  ImplicitGoal hold(const ImplicitPush& push, const ImplicitSurface& surface,
                    ImplicitProxyState& state);

  // Returns the lag of the tool's nearest point that a friction model asks for; zero otherwise.
  [[nodiscard]] const Vec3& lag_O() const { return lag_O_; }

 private:
  ImplicitGoal stay_in_cone(const ImplicitPush& push, const ImplicitSurface& surface,
                            ImplicitProxyState& state);
  ImplicitGoal lag_behind(const ImplicitPush& push, const ImplicitSurface& surface,
                          ImplicitProxyState& state);

  const Material& material_;
  // True once the proxy slipped in this tick: it then slips in the rest of it.
  bool slipped_ = false;
  Vec3 lag_O_ = Vec3::Zero();
};

}  // namespace tactus::rendering
