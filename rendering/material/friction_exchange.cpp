#include "rendering/material/friction_exchange.h"

#include <algorithm>

namespace tactus::rendering {
namespace {

// Returns the static level that the material now has, or had in the scene; at least the dynamic
// one.
double static_level(const FrictionParameters& now, const FrictionParameters& baked) {
  if (has_static_level(now.kind)) {
    return now.static_level;
  }
  return has_static_level(baked.kind) ? std::max(baked.static_level, now.coulomb) : now.coulomb;
}

// Returns the viscous term that the material now has, or had in the scene.
double viscous_term(const FrictionParameters& now, const FrictionParameters& baked) {
  return is_viscous(now.kind)     ? now.viscous_s_per_m
         : is_viscous(baked.kind) ? baked.viscous_s_per_m
                                  : 0.0;
}

}  // namespace

Material with_friction_model(const Material& now, const Material& baked, FrictionKind kind) {
  FrictionParameters friction = kSurfaceFriction;
  friction.kind = kind;
  for (const auto parameter : kFrictionModels[static_cast<std::size_t>(kind)].parameters) {
    if (has_on_surface(kind, parameter) && has_on_surface(baked.friction.kind, parameter)) {
      friction.*parameter = baked.friction.*parameter;
    }
  }
  friction.coulomb = now.friction.coulomb;
  friction.static_level =
      has_static_level(kind) ? static_level(now.friction, baked.friction) : friction.coulomb;
  friction.viscous_s_per_m = is_viscous(kind) ? viscous_term(now.friction, baked.friction) : 0.0;
  if (has_bristles(kind) && !(friction.stiffness_N_per_m > 0.0)) {
    friction.stiffness_N_per_m = now.stiffness_N_per_m;
  }
  Material other = now;
  other.friction = friction;
  return other;
}

}  // namespace tactus::rendering
