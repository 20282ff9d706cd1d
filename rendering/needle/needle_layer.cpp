#include "rendering/needle/needle_layer.h"

#include <algorithm>

namespace tactus::rendering {

void NeedleLayer::place(const NeedlePose& needle_O, bool is_inside_now) {
  *this = {};
  is_inside = is_inside_now;
  is_left_out = is_inside_now;
  last = needle_O;
}

// A needle that comes in within its own width of the old channel, and along it, is in that channel.
void NeedleLayer::meet(const Needle& needle, const NeedlePose& now, const Vec3& entry_O) {
  // The cosine of 2 degrees.
  constexpr double kSameDirection = 0.99939;
  const Vec3 from_channel = entry_O - channel.entry_O;
  const Vec3 aside = from_channel - channel.direction_O.dot(from_channel) * channel.direction_O;
  if (channel.exists && aside.squaredNorm() <= needle.width_m * needle.width_m &&
      now.axis_O.dot(channel.direction_O) >= kSameDirection) {
    depth_m = (now.tip_O - channel.entry_O).dot(channel.direction_O);
    phase = depth_m > 0.0 ? LayerPhase::pierced : LayerPhase::away;
    return;
  }
  channel = {.entry_O = entry_O, .direction_O = now.axis_O, .front_m = 0.0, .exists = false};
  depth_m = std::max((now.tip_O - entry_O).dot(now.axis_O), 0.0);
  phase = LayerPhase::pressed;
}

void NeedleLayer::follow(const NeedlePose& now, const SurfaceCrossing& crossing) {
  is_inside = crossing.ends_inside;
  is_left_out = is_left_out && is_inside;
  if (!is_met()) {
    return;
  }
  depth_m = (now.tip_O - channel.entry_O).dot(channel.direction_O);
  if (crossing.leaves && !is_inside) {
    const Vec3 exit_O = last.tip_O + crossing.exit * (now.tip_O - last.tip_O);
    exit_m = (exit_O - channel.entry_O).dot(channel.direction_O);
    is_left = exit_m > 0.0;
  }
  is_left = is_left && !is_inside;
}

// The part of the shaft in the layer moves sideways with its middle. A longer part keeps the force,
// a shorter one the stretch: both lessen the energy.
Vec3 NeedleLayer::hold_sideways(const Tissue& tissue, const NeedlePose& now, double near_m,
                                double far_m, NeedleEnergy& energy) {
  const double stiffness = tissue.lateral_stiffness_N_per_m2;
  const double length = std::max(far_m - near_m, 0.0);
  const double middle = near_m + 0.5 * length;
  const double before_J = sideways_J(tissue);
  if (length > length_m) {
    sideways_O *= length_m / length;
  }
  length_m = length;
  energy.freed_J += before_J - sideways_J(tissue);
  const Vec3 moved = (now.tip_O - middle * now.axis_O) - (last.tip_O - middle * last.axis_O);
  sideways_O += moved;
  sideways_O -= now.axis_O.dot(sideways_O) * now.axis_O;
  return -stiffness * length * sideways_O;
}

void NeedleLayer::let_go(const Tissue& tissue, NeedleEnergy& energy) {
  energy.freed_J += sideways_J(tissue) + shaft.stored_J(tissue, length_m);
  if (phase == LayerPhase::pressed) {
    channel.exists = false;
  }
  phase = LayerPhase::away;
  is_left = false;
  depth_m = 0.0;
  length_m = 0.0;
  shaft = {};
  sideways_O = Vec3::Zero();
}

}  // namespace tactus::rendering
