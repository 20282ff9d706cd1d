// Moves straight to the tool where the proxy cannot slide: among more surfaces than are kept it can
// still leave.
#pragma once

#include "rendering/contact/moving_proxy.h"
#include "rendering/contact/nearby_surfaces.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Sweeps straight to the tool h_W (world frame, m). The sweep needs no candidates: it goes through
// the hierarchies, within kMaxCarryBudget.
void sweep_to_tool(const NearbySurfaces& near, const Vec3& h_W, ProxyState& state);

// Does the same in the first sub-goal of a tick if more planes hold the sphere than are kept. Call
// it if no move along the planes is free. A proxy that arrives is out of contact.
void escape_overfull_planes(const NearbySurfaces& near, const Vec3& h_W, const MovingProxy& proxy);

}  // namespace tactus::rendering
