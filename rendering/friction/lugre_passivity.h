// Checks whether LuGre's damping can give out energy, and what to change. It is for baking, not for
// the loop.
//
// With V = sigma0 z^2 / 2, the supplied power less dV/dt is a quadratic form in v and z, which is
// nowhere negative if at every speed
//   sigma1(v)^2 v / (4 (sigma1(v) + sigma2)) <= g(v).
// A constant sigma1 breaks this above some speed; one that fades early enough does not. Here g is
// taken as its least value Fc. A second condition (Barahanov and Ortega, IEEE Transactions on
// Automatic Control 45(7), 2000) uses |z| <= Fs N / sigma0: dz/dt points against v by at most v (Fs
// - Fc) / Fc, and
//   sigma2 >= sigma1 (Fs - Fc) / Fc
// compensates for it. Either condition suffices. The normal force is a factor of both sides of
// both. A tick of update_friction is the continuous model at constant velocity, so the conditions
// hold for it too. The yielding of the elasto-plastic model is weaker, and the same conditions
// suffice.
#pragma once

#include "rendering/friction/friction_model.h"

namespace tactus::rendering {

struct LugrePassivity {
  bool passive = true;
  // At this sigma2 or above the model is passive for every sigma1.
  double needed_viscous_s_per_m = 0.0;
  // At a damping_fade_m_per_s above 0 and up to this the model is passive for every sigma2;
  // infinity if sigma1 is 0.
  double largest_fade_m_per_s = 0.0;
  // No motion below this speed gets energy out of the model as it is; infinity if it is passive.
  double safe_speed_m_per_s = 0.0;
};

// Checks models of damped bristles, as lugre and elasto_plastic; the other kinds are passive. The
// parameters must be valid.
LugrePassivity lugre_passivity(const FrictionParameters& parameters);

}  // namespace tactus::rendering
