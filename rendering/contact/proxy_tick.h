// Moves the shared proxy in one tick. proxy_tick.cpp describes the steps.
#pragma once

#include "rendering/contact/moving_proxy.h"

namespace tactus::rendering {

// Repeats sub-goals until the proxy settles or a limit is reached. The proxy's state is moved on,
// its planes are those where it ends, and its rest receives the contact. `watch` sees the moves
// (tick_watch.h). Bounded time, no heap.
template <class Watch>
void run_sub_goals(const ProxyMove& tick, const MovingProxy& proxy, Watch watch);

}  // namespace tactus::rendering
