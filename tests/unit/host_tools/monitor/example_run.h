// Ticks as a controller with three joints would publish them.
#pragma once

#include <cstdint>

#include "host_tools/monitor/run_view.h"

namespace tactus::host {

// Returns a tick in contact and active, woken `latency_us` after its time at 1 kHz.
firmware::RecordedTick example_tick(std::uint64_t tick, std::int64_t latency_us);

// Returns the explanation of such a tick, whose proxy slips along an edge.
firmware::Explanation example_explanation();

// A hundred such ticks, most of them woken after 3 us, one after 60 and one after 1500.
RunView example_run();

}  // namespace tactus::host
