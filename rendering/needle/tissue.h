// The tissue that makes an object a layer which a needle pierces, and the needle of a tool.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The friction on the shaft for each metre of it in the tissue, in one direction of motion.
struct ShaftFriction {
  // The force that a shaft at rest takes before it slips, N/m, and the one of a slip, at most that.
  double static_N_per_m = 0.0;
  double dynamic_N_per_m = 0.0;
  // The part that grows with the speed, N s/m^2.
  double viscous_Ns_per_m2 = 0.0;
};

// A layer of tissue. An object that has one is closed; the needle alone meets it.
struct Tissue {
  // The force of the surface that is pressed in by d metres: linear d + quadratic d^2 (Okamura,
  // Simone and O'Leary 2004). It gives way at `puncture_force_N`; 0 is a tissue without a membrane.
  double stiffness_N_per_m = 0.0;
  double stiffness_N_per_m2 = 0.0;
  double puncture_force_N = 0.0;
  // The depth by which the surface stays pressed in after the puncture, m.
  double residual_m = 0.0;
  // The force on the tip that cuts, N, and the part of it that makes a crack: J for each m^2 of
  // crack. The rest spreads the tissue, and is there in an old channel too.
  double cutting_force_N = 0.0;
  double toughness_J_per_m2 = 0.0;
  // The friction on a shaft that goes in and on one that goes out.
  ShaftFriction in;
  ShaftFriction out;
  // The spring by which a shaft sticks, for each metre of it, N/m^2.
  double shaft_stiffness_N_per_m2 = 5e4;
  // The spring that holds the shaft sideways, for each metre of it, N/m^2.
  double lateral_stiffness_N_per_m2 = 0.0;
  // The time in which the force on a tip at rest falls to what just does not cut, s.
  double relaxation_s = 0.1;
};

// A needle. Its tip is the tool's position.
struct Needle {
  // The direction in which it pierces, from the hub to the tip, of length 1.
  Vec3 axis_W = -Vec3::UnitY();
  // The length of the shaft, m; 0 is no needle. No friction acts beyond it.
  double length_m = 0.0;
  // The width of the crack that it cuts, m.
  double width_m = 1e-3;
  // The spring between the tip and what it cuts, N/m.
  double tip_stiffness_N_per_m = 2000.0;
};

// The needle and the tissues of a scene; Object::tissue counts the tissues.
struct NeedleScene {
  Needle needle;
  std::span<const Tissue> tissues;
};

// The most that a spring and a damper in all directions can be of what a needle makes the hand
// feel.
struct NeedleImpedance {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
};

// Returns a bound for every place of the needle in the scene: the steepest membrane at its
// puncture, the tip, and the stiffest of the layers along the whole shaft; across the axis the
// spring that holds the shaft. 0 without a needle or a tissue.
NeedleImpedance largest_impedance(const NeedleScene& scene);

// A tip or a shaft that is slower than this is at rest, m/s (Karnopp's band).
inline constexpr double kNeedleRest_m_per_s = 5e-4;

// Numbers that a layer may have; the largest of each kind.
inline constexpr double kMostNeedleForce_N = 1e3;
inline constexpr double kMostNeedleStiffness = 1e9;

// Returns true if the needle's numbers are finite and in range, or if there is none.
bool valid(const Needle& needle);

// Returns true if all numbers are finite and in range, dynamic friction is at most static, a
// membrane can reach its puncture force, and cutting takes at least the force of the fracture.
bool valid(const Tissue& tissue, const Needle& needle);

// Returns how deep the surface is pressed in when it gives way, m; 0 without a membrane.
double puncture_depth_m(const Tissue& tissue);

// Returns the force of a surface that is pressed in by so much, N, and the energy in it, J.
double membrane_force_N(const Tissue& tissue, double depth_m);
double membrane_energy_J(const Tissue& tissue, double depth_m);

// Returns the force of a crack of the needle's width, J w, N.
inline double fracture_force_N(const Tissue& tissue, const Needle& needle) {
  return tissue.toughness_J_per_m2 * needle.width_m;
}

// Returns the least residual depth for which the energy of the puncture pays for the crack as far
// as the tip, m.
double least_residual_m(const Tissue& tissue, const Needle& needle);

// Returns the residual depth for which the energy of the puncture is just what cutting and sliding
// as far as the tip take, m; 0 if it is more. Nothing is then freed.
double balanced_residual_m(const Tissue& tissue);

}  // namespace tactus::rendering
