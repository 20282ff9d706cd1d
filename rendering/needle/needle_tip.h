// The force on the tip: a spring between the tip and the front of what it cuts.
#pragma once

#include "rendering/needle/needle_energy.h"
#include "rendering/needle/tissue.h"

namespace tactus::rendering {

// The place of a tip in its channel. Depths are measured along the channel from where the needle
// came in; m.
struct TipPlace {
  double depth_m = 0.0;
  // The least depth at which there is tissue.
  double begin_m = 0.0;
  // The motion of the tip in this tick; m, m/s.
  double travel_m = 0.0;
  double v_m_per_s = 0.0;
};

// The spring is stretched until the force of the tissue is reached; then its far end follows. In
// fresh tissue it cuts and moves the front of the channel, in a channel it spreads the tissue only.
// It never pulls. At rest the force falls to what just does not cut.
struct NeedleTip {
  // The force of the spring, N, >= 0.
  double force_N = 0.0;

  // Moves a tip in a channel whose front is at `front_m`, and moves the front.
  void cut(const Tissue& tissue, const Needle& needle, const TipPlace& place, double tick_s,
           double& front_m, NeedleEnergy& energy);
  // Moves a tip that presses on a membrane: the spring holds at most `level_N`.
  void press(const Needle& needle, double travel_m, double level_N, NeedleEnergy& energy);
  // Lets go.
  void let_go(const Needle& needle, NeedleEnergy& energy);
  // Returns the energy in the spring, J.
  [[nodiscard]] double stored_J(const Needle& needle) const {
    return force_N * force_N / (2.0 * needle.tip_stiffness_N_per_m);
  }

 private:
  void relax(const Tissue& tissue, const Needle& needle, const TipPlace& place, double tick_s,
             double& front_m, NeedleEnergy& energy);
};

}  // namespace tactus::rendering
