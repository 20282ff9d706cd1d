// One layer of tissue as a needle meets it: whether it is pressed in or pierced, where, and what
// holds the shaft in it.
#pragma once

#include <cstdint>

#include "rendering/geometry/vector.h"
#include "rendering/needle/needle_energy.h"
#include "rendering/needle/shaft_bristle.h"
#include "rendering/needle/surface_crossing.h"
#include "rendering/needle/tissue.h"

namespace tactus::rendering {

// The relation of the needle to a layer.
enum class LayerPhase : std::uint8_t {
  away = 0,     // it does not touch the layer
  pressed = 1,  // it presses the surface in
  pierced = 2,  // it is in the layer
};

// The needle at the end of a tick, in the frame O of a layer's object.
struct NeedlePose {
  // The tip, m, and the unit direction from the hub to the tip.
  Vec3 tip_O = Vec3::Zero();
  Vec3 axis_O = Vec3::Zero();
};

// The channel that a needle leaves in a layer: one, the last.
struct NeedleChannel {
  // The place at which the needle came in, m, on the surface that nothing presses, and the unit
  // direction of the channel inward.
  Vec3 entry_O = Vec3::Zero();
  Vec3 direction_O = Vec3::Zero();
  // The depth to which it is cut, m along the direction.
  double front_m = 0.0;
  bool exists = false;
};

// The state of a layer from tick to tick. Depths are along the channel's direction from its entry.
struct NeedleLayer {
  LayerPhase phase = LayerPhase::away;
  // True for a layer in which the needle began, until it is out of it.
  bool is_left_out = false;
  // True if the tip is within the surface as it is at rest.
  bool is_inside = false;
  // True if the tip has left the layer on its far side, at the depth `exit_m`.
  bool is_left = false;
  double exit_m = 0.0;
  // The depth of the tip, m.
  double depth_m = 0.0;
  // The length of the shaft in the layer, m; of one that is pressed in, its depth.
  double length_m = 0.0;
  NeedleChannel channel;
  ShaftBristle shaft;
  // The stretch of the spring that holds the shaft sideways, m.
  Vec3 sideways_O = Vec3::Zero();
  // The needle in the last tick.
  NeedlePose last;

  // Starts over with a needle that begins there; a layer that it begins in is left out.
  void place(const NeedlePose& needle_O, bool is_inside_now);
  // Follows a motion of the tip through the surface as it is at rest.
  void follow(const NeedlePose& now, const SurfaceCrossing& crossing);
  // Comes into contact at a point of the axis: in the old channel, or at a surface to be pierced.
  void meet(const Needle& needle, const NeedlePose& now, const Vec3& entry_O);

  // Returns true if the tip has met the layer.
  [[nodiscard]] bool is_met() const { return phase != LayerPhase::away; }
  // Returns the depth where the tissue of a layer begins, m: behind a surface that stays pressed
  // in.
  [[nodiscard]] double begin_m(const Tissue& tissue) const {
    return phase == LayerPhase::pierced ? tissue.residual_m : 0.0;
  }
  // Returns how far the tip has moved along the axis since the last tick, m.
  [[nodiscard]] double travel_m(const NeedlePose& now) const {
    return (now.tip_O - last.tip_O).dot(now.axis_O);
  }

  // Takes the part of the shaft that is in the layer, from `near_m` to `far_m` behind the tip, and
  // returns the force sideways on the needle, N.
  Vec3 hold_sideways(const Tissue& tissue, const NeedlePose& now, double near_m, double far_m,
                     NeedleEnergy& energy);
  // Returns the energy in the spring that holds the shaft sideways, J.
  [[nodiscard]] double sideways_J(const Tissue& tissue) const {
    return 0.5 * tissue.lateral_stiffness_N_per_m2 * length_m * sideways_O.squaredNorm();
  }
  // Forgets the contact; the channel stays.
  void let_go(const Tissue& tissue, NeedleEnergy& energy);
};

}  // namespace tactus::rendering
