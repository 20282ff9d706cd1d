// A point proxy on an implicit surface: the tracking of Salisbury and Tarr ("Haptic rendering of
// surfaces defined by implicit functions", ASME DSC 61, 1997) made safe. The tool is a point; its
// radius is not used. (A formula that is a distance, such as sphere(1), is felt by a sphere of
// radius r as f - r; rendering/surface/README.md names those that are.)
#pragma once

#include <cstdint>

#include "rendering/contact/crease_walls.h"
#include "rendering/contact/tick_watch.h"
#include "rendering/friction/surface_friction.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/material/material.h"
#include "rendering/state_archive.h"
#include "rendering/surface/implicit_surface.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// The proxy's position after a tick.
struct ImplicitRest {
  Vec3 proxy_W = Vec3::Zero();   // m; 0.1 um above the surface in contact
  Vec3 normal_W = Vec3::Zero();  // unit, away from the surface; zero without contact
  double depth_m = 0.0;          // (proxy - tool) . normal; 0 without contact
  FrictionState friction = FrictionState::free;
  // The number of tangent planes that hold the proxy: 0 without contact, 1 on smooth ground, 2 in a
  // crease, 3 in a corner.
  std::uint8_t planes = 0;
  std::uint16_t sub_goals = 0;
  // The number of formula instructions evaluated.
  std::size_t evaluated = 0;
  // TouchFlags: iterations exhausted, tool invalid.
  std::uint32_t flags = kTouchClean;
};

// The state is kept in the object's frame: a surface that moves carries the proxy along, and meets
// every tool that it sweeps over.
struct ImplicitProxyState {
  Vec3 p_O = Vec3::Zero();
  // The sign of f at the proxy: 1 for f >= 0, -1 for f < 0; 0 while it is not known.
  double side = 0.0;
  FrictionState friction = FrictionState::free;
  SurfaceFriction model;
  CreaseWalls walls;
};

// One proxy on one implicit surface. IndependentContacts (rendering/world/independent_contacts.h)
// has one for each such object and tool.
class ImplicitTracker {
 public:
  // Starts over, out of contact, at p_W. To be called before the first tick, and when the formula
  // or the bounds of the surface change.
  void place(const Vec3& p_W);

  // Sets the motion that drives the friction models; call it first in a tick (see SurfaceFriction).
  void begin_friction(const Vec3& tool_step_W, double tick_s) {
    state_.model.begin_tick(tool_step_W, tick_s);
  }

  // Moves the proxy as near to the tool as the surface and friction allow. The proxy moves only
  // along segments that interval arithmetic proves free, however far the tool jumps and however
  // thin the surface is. Each move brings it nearer to the tool, so it cannot oscillate. A tool
  // that is not finite or beyond kWorldBound_m leaves the proxy where it is. Real time: no heap,
  // at most `budget` formula instructions evaluated. `watch` sees the sub-goals.
  template <class Watch = Unwatched>
  ImplicitRest advance(const ImplicitSurface& surface, const Material& material, const Vec3& h_W,
                       std::size_t budget = kMaxFormulaBudget, Watch watch = {});

  // Returns the proxy's position after the last tick; world frame, m.
  [[nodiscard]] const Vec3& position_W() const { return p_W_; }

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  Vec3 p_W_ = Vec3::Zero();
  bool placed_ = false;  // the state is in the object's frame
  ImplicitProxyState state_;
};

}  // namespace tactus::rendering
