// The state of the shared proxy: everything that one tick takes over from the tick before.
#pragma once

#include "rendering/contact/last_contact.h"
#include "rendering/contact/unpressed_depth.h"
#include "rendering/friction/joint_friction.h"
#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// A tick that is repeated toward another goal starts from a copy of the state at its start.
struct ProxyState {
  // The proxy's centre; world frame, m.
  Vec3 p_W = Vec3::Zero();
  // The state of the friction circle, or that of the friction models if they run.
  FrictionState friction = FrictionState::free;
  // The memory of the friction models: bristles and what drives them.
  JointFriction models;
  // The contact with the largest pressure. Its object carries the proxy when it moves, and gives
  // the force in a tick that ends early.
  LastContact last_contact;
  // All contacts. A proxy with friction keeps their planes.
  HeldBy held_by;
  UnpressedDepths unpressed;
  // True if the last tick ended where the tool and friction want the proxy; and the goal for which
  // it came there, world frame, m.
  bool is_settled = false;
  Vec3 settled_for_W = Vec3::Zero();
};

}  // namespace tactus::rendering
