// Finds how stiff a wall, or a stuck bristle, a sampled device can hold. It is for baking, not for
// the loop.
//
// A bristle that sticks is a virtual wall: the device, m x'' + b x' = u, is read every T, and
// commanded u = -K x_k - B (x_k - x_(k-1)) / T, held over the tick that begins n ticks later. It is
// stable if all roots of its characteristic polynomial lie within the unit circle, which Schur and
// Cohn's recursion decides without finding them.
#pragma once

namespace tactus::rendering {

// Beyond: every limit below is 0, every radius infinite.
inline constexpr int kMaxDelayTicks = 16;

struct SampledDevice {
  double mass_kg = 0.1;           // > 0, what the hand feels moving
  double damping_Ns_per_m = 0.0;  // >= 0, the device's own
  double step_s = 1e-3;           // > 0
  int delay_ticks = 0;            // whole ticks from the reading to the force
};

// K >= 0 and B >= 0: sigma0, and sigma1 times the largest normal force.
struct RenderedSpring {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
};

// Returns the largest modulus of a root, to 1e-12. The device is stable below 1; without a spring
// it is 1.
double spectral_radius(const SampledDevice& device, const RenderedSpring& spring);

// Returns the largest K that is stable with this B, to a relative 1e-9; 0 if none is.
double largest_stable_stiffness(const SampledDevice& device, double damping_Ns_per_m);

// The largest B that is stable with this K, likewise; 0 if none but B = 0 is, or not even that.
double largest_stable_damping(const SampledDevice& device, double stiffness_N_per_m);

}  // namespace tactus::rendering
