// The state of the shared proxy: everything that one tick takes over from the tick before.
#pragma once

#include "rendering/contact/carry_along.h"
#include "rendering/friction/surface_friction.h"
#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// A tick that is repeated toward another goal starts from a copy of the state at its start.
struct ProxyState {
  Vec3 p_W = Vec3::Zero();                       // the proxy's centre, m
  FrictionState friction = FrictionState::free;  // of the friction circle or the friction model
  SurfaceFriction model;                         // of the friction models
  LastContact last_contact;                      // the contact with the largest pressure
};

}  // namespace tactus::rendering
