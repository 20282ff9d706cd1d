// Whether LuGre's damping can give out energy, and what to change. For the time of baking.
//
// With V = sigma0 z^2 / 2, the power that goes in less dV/dt is a quadratic form in v and z, which
// is nowhere negative if at every speed
//   sigma1(v)^2 v / (4 (sigma1(v) + sigma2)) <= g(v).
// A constant sigma1 breaks that above some speed, one that fades does not if it fades early enough.
// Here g is taken as its least value Fc. The other way (Barahanov and Ortega, IEEE Transactions on
// Automatic Control 45(7), 2000): since |z| <= Fs N / sigma0, dz/dt points against v by at most
// v (Fs - Fc) / Fc, and
//   sigma2 >= sigma1 (Fs - Fc) / Fc
// makes up for that. Either suffices. The normal force is a factor of both sides of both. A tick of
// update_friction is the continuous model at constant velocity, so that this is what holds of it
// too. The yielding of the elasto-plastic model is weaker, and the same conditions suffice.
#pragma once

#include "rendering/friction/friction_model.h"

namespace tactus::rendering {

struct LugrePassivity {
  bool passive = true;
  // With this sigma2 or more it is passive whatever sigma1 does.
  double needed_viscous_s_per_m = 0.0;
  // With damping_fade_m_per_s above 0 and at most this it is passive whatever sigma2 is; infinity
  // if sigma1 is 0.
  double largest_fade_m_per_s = 0.0;
  // As it is, no motion below this speed gets energy out of it; infinity if it is passive.
  double safe_speed_m_per_s = 0.0;
};

// Of lugre and elasto_plastic; the other kinds have no sigma1 and are passive. The parameters must
// be valid.
LugrePassivity lugre_passivity(const FrictionParameters& parameters);

}  // namespace tactus::rendering
