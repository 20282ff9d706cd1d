// Moves a proxy on an implicit surface in one tick. implicit_tick.cpp describes the steps.
#pragma once

#include <cstddef>

#include "rendering/contact/implicit_tracking.h"

namespace tactus::rendering {

// Repeats sub-goals until the proxy settles or a limit is reached. `state` is moved on toward the
// tool `h_O` (object frame). At most `budget` formula instructions are evaluated. The result lacks
// what follows from the state: the proxy, its depth and its friction. Bounded time, no heap.
// `watch` sees the sub-goals (tick_watch.h).
template <class Watch>
ImplicitRest run_implicit_tick(ImplicitProxyState& state, const ImplicitSurface& surface,
                               const Material& material, const Vec3& h_O, std::size_t budget,
                               Watch watch);

}  // namespace tactus::rendering
