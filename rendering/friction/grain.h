// Friction that differs along and across a grain.
//
// The symmetric matrix S = along d d' + across (1 - d d') takes the motion into a space where the
// friction is isotropic, and the force back: F(dx) = S f(S dx). Its work F . dx is the work
// f . (S dx) there, so that whatever holds of the energy of a model holds of it with a grain, also
// where the grain changes from place to place. The friction circle becomes an ellipse, and slip
// goes in the direction that loses the most energy: perpendicular to the ellipse, not against the
// force.
#pragma once

#include "rendering/friction/friction_model.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The coefficients of friction (Fc, Fs, sigma2, sigma1) along and across are the parameters' times
// these factors; sigma2, sigma1 and sigma0 carry the factor squared. The parameters should be those
// of the rougher direction, whose factor is 1, since they are what a device's stability is checked
// for.
struct Grain {
  Vec3 direction = Vec3::UnitX();  // unit, in the contact plane
  double along = 1.0;              // in [0, 1]
  double across = 1.0;             // in [0, 1]
};

// S v, for the motion on input and for the force on output.
inline Vec3 through(const Grain& grain, const Vec3& v) {
  return grain.across * v +
         ((grain.along - grain.across) * grain.direction.dot(v)) * grain.direction;
}

// update_friction with a grain. The memory is that of the isotropic space; so is `bristle_m`.
FrictionForce<Vec3> update_friction(const FrictionParameters& parameters, const Grain& grain,
                                    FrictionMemory<Vec3>& memory, const Vec3& displacement_m,
                                    double normal_force_N, double step_s);

}  // namespace tactus::rendering
