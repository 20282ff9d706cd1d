// Moves the shared proxy in one tick. proxy_tick.cpp describes the steps.
#pragma once

#include "rendering/contact/contact_planes.h"
#include "rendering/contact/nearby_surfaces.h"
#include "rendering/contact/proxy_rest.h"
#include "rendering/contact/proxy_state.h"

namespace tactus::rendering {

// The goal of a tick, and the surfaces on the path to it.
struct ProxyMove {
  const NearbySurfaces& near;
  const FrictionFactors& factors;
  const Vec3& h_W;  // the tool; world frame, m
  ProxyPath* path;  // receives the moves if it is not null
};

// Repeats sub-goals until the proxy settles or a limit is reached. `state` is moved on. `planes`
// are those at the proxy, and `rest` receives the contact. Bounded time, no heap.
void run_sub_goals(const ProxyMove& move, ProxyState& state, ContactPlanes& planes,
                   ProxyRest& rest);

// Returns the contact of `rest` with the largest pressure, by which objects that move carry the
// proxy in the next tick; none if no plane pushes.
LastContact hardest_contact(const ProxyRest& rest);

}  // namespace tactus::rendering
