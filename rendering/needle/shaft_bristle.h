// The friction of one layer on the shaft (Karnopp's model, modified by Okamura, Simone and O'Leary
// 2004 to forces for each inserted length), with a spring in place of their applied force: a device
// that renders forces knows positions.
#pragma once

#include <cstdint>

#include "rendering/needle/needle_energy.h"
#include "rendering/needle/tissue.h"

namespace tactus::rendering {

// The motion of the needle in one tick, seen from the layer.
struct ShaftMotion {
  // The way and the velocity along the axis; positive goes in. m, m/s.
  double travel_m = 0.0;
  double v_m_per_s = 0.0;
  // The length of the shaft in the layer before and after, m.
  double length_before_m = 0.0;
  double length_m = 0.0;
};

// The spring's force never exceeds the friction. Where the length in the tissue changes, the spring
// loses energy and gains none, so that no path gives out energy: a length that is added is not
// stretched, and one that is left takes its share along.
struct ShaftBristle {
  // The force of the spring against the needle, N; positive holds one back that goes in.
  double force_N = 0.0;
  // True for a slip inward and for one outward; both false for a shaft that sticks.
  bool slips_in = false;
  bool slips_out = false;

  // Moves the needle, and returns the force that holds it back, with the part of the speed, N.
  double advance(const Tissue& tissue, const ShaftMotion& motion, NeedleEnergy& energy);
  // Returns the energy in the spring of a shaft of that length, J.
  [[nodiscard]] double stored_J(const Tissue& tissue, double length_m) const;

 private:
  void take_length(const Tissue& tissue, const ShaftMotion& motion, NeedleEnergy& energy);
};

}  // namespace tactus::rendering
