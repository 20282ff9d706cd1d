// Exchanges the friction model of a material, as if its scene had given the other model.
#pragma once

#include "rendering/material/material.h"

namespace tactus::rendering {

// Returns the material `now` with another friction model.
//
// - The friction levels and the viscous term stay as they are now. A static level or a viscous term
//   that the present model lacks is the one of `baked`, the material in the scene; without one
//   there, the static level is the dynamic one and the viscous term 0.
// - Every other parameter is that of `baked`, if the baked model has it, or else the one that a
//   scene gets for a key that it leaves out: those of kSurfaceFriction, and for bristles the
//   contact's stiffness.
//
// The result is not sound() if the model needs bristles and the contact has no stiffness.
Material with_friction_model(const Material& now, const Material& baked, FrictionKind kind);

}  // namespace tactus::rendering
