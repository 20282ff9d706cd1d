// A whole recording lived once more, tick against tick.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "host_tools/replay/recorded_run.h"
#include "host_tools/replay/replayer.h"

namespace tactus::host {

struct ReplayResult {
  std::uint64_t first_tick = 0;
  std::uint64_t ticks = 0;  // that were equal
  bool cut = false;         // the recording lacks its end
  std::optional<Difference> difference;
};

// Called after every equal tick with what was recorded.
using ReplaySink = std::function<void(const firmware::RecordedTick&)>;

// Up to the first tick that differs. Throws InputError where the recording is damaged, or does not
// begin where it can be replayed from, or ticks are missing in it.
ReplayResult replay(RecordedRun& run, const ReplaySink& sink = {});

}  // namespace tactus::host
