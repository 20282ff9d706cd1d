// The tracking of an implicit surface as the textbook has it (Salisbury and Tarr, "Haptic rendering
// of surfaces defined by implicit functions", ASME DSC 61, 1997), kept with its faults so that they
// can be felt and compared. World::touch uses it for the contact method plain_tracking. README.md
// in this folder shows every fault with its remedy; the method `tracking` has none of them:
//
// - contact is found where the tool is inside, so a thin object is passed in one tick;
// - pressed deeper than the radius of a hollow, the point swings between two places;
// - contact ends when the tool is in front of the last tangent plane, inside the object or not;
// - the point may jump to another sheet.
#pragma once

#include <cstddef>

#include "rendering/contact/tick_watch.h"
#include "rendering/state_archive.h"
#include "rendering/surface/implicit_surface.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// The end of Newton's steps to a surface.
struct Seed {
  Vec3 point = Vec3::Zero();
  // False if the gradient vanishes or the steps were too many.
  bool converged = false;
  int steps = 0;
};

// Returns the surface point that Newton's steps along the gradient reach from a start near the
// surface, in the formula's units: p <- p - f grad f / |grad f|^2, until a step is below 1e-13. At
// most 50 steps. Real time.
Seed seed(const FormulaView& formula, const Vec3& start);

// Returns the next surface contact point: projects the tool on the tangent plane at `contact`, and
// seeds from there. Formula's units.
Seed plain_tracking_step(const FormulaView& formula, const Vec3& contact, const Vec3& tool);

// The surface contact point after a tick.
struct PlainRest {
  // The point, world frame, m; the tool without contact.
  Vec3 proxy_W = Vec3::Zero();
  // The unit normal of the surface there, toward the free side; zero without contact.
  Vec3 normal_W = Vec3::Zero();
  // (proxy - tool) . normal, m; 0 without contact.
  double depth_m = 0.0;
  bool in_contact = false;
  // The number of Newton's steps.
  int steps = 0;
  // TouchFlags: iterations exhausted where the steps do not converge, tool invalid.
  std::uint32_t flags = kTouchClean;
};

// One point on one implicit surface, without friction. Positions are in the object's frame, world
// frame for a surface at rest. `sides` of the surface is taken as it is: with two sides contact
// begins where f changes its sign within the box.
class PlainTracker {
 public:
  // Starts over, out of contact, at p_W.
  void place(const Vec3& p_W);

  // Computes a tick. A tool that is not finite or beyond kWorldBound_m leaves the point where it
  // is. Real time: no heap. `watch` sees the step.
  template <class Watch = Unwatched>
  PlainRest advance(const ImplicitSurface& surface, const Vec3& tool_W, Watch watch = {});

  // Returns the point after the last tick; world frame, m.
  [[nodiscard]] const Vec3& position_W() const { return p_W_; }

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  // Return the surface point of this tick from the last one, and from a free tool, and set
  // `in_contact_`; object frame. They return the tool without contact.
  Seed track(const ImplicitSurface& surface, const Vec3& contact, const Vec3& tool);
  Seed look_for_contact(const ImplicitSurface& surface, const Vec3& before, const Vec3& tool,
                        std::uint32_t& flags);

  Vec3 p_W_ = Vec3::Zero();
  // The sign of f on the free side, where the tool came from; 0 before the first tick, and where a
  // two-sided surface has ended.
  double side_ = 0.0;
  bool in_contact_ = false;
};

}  // namespace tactus::rendering
