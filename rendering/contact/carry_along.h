// Moves a resting proxy with the objects that moved since the last tick: the object in contact
// carries it along, and every object in its path pushes it, at any speed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rendering/contact/last_contact.h"
#include "rendering/contact/left_out.h"
#include "rendering/contact/sphere_sweep.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// The result of carrying the proxy.
struct Carried {
  // The proxy's position; world frame, m. It is clear of every object where that is now, unless
  // `flags` say otherwise.
  Vec3 p_W = Vec3::Zero();
  // kTouchPinched if objects that moved have passed over the proxy.
  std::uint32_t flags = kTouchClean;
  // The cost units spent (tick_budget.h).
  std::size_t spent = 0;
};

// Moves the proxy so that it stays clear of every object where it is now. `p_W` is its position
// before the tick (world frame, m), clear of every object as it was then, except those in
// `left_out`. In the frame of each object the proxy moves along a straight segment and crosses
// nothing. SphereProxy calls it first in a tick in which anything moved. Real time: bounded time
// (kMaxCarryBudget), no heap.
Carried carry_along(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p_W,
                    const LastContact& last_contact, const LeftOut& left_out = {});

}  // namespace tactus::rendering
