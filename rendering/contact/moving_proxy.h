// The proxy in the course of a tick, as the steps of proxy_tick.cpp pass it on.
#pragma once

#include "rendering/contact/contact_planes.h"
#include "rendering/contact/nearby_surfaces.h"
#include "rendering/contact/proxy_rest.h"
#include "rendering/contact/proxy_state.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The goal of a tick, and the surfaces on the path to it.
struct ProxyMove {
  const NearbySurfaces& near;
  const FrictionFactors& factors;
  const Vec3& h_W;  // the tool; world frame, m
};

// The proxy, which the steps move on.
struct MovingProxy {
  ProxyState& state;
  ContactPlanes& planes;  // at the proxy
  ProxyRest& rest;        // the contact and the flags so far
};

}  // namespace tactus::rendering
