// The real-time thread of tactusd's loop.
#pragma once

#include "firmware/linux/realtime/real_time.h"
#include "firmware/linux/tactusd/options.h"

namespace tactus::firmware {

// Makes this thread a real-time thread, and holds the request that keeps processors awake. Returns
// false after it has printed why to stderr, unless --allow-non-realtime is given.
bool take_time(const Options& options, CpuLatencyRequest& cpu_latency);

}  // namespace tactus::firmware
