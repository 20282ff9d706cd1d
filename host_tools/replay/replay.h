// Replays a whole recording and compares every tick's state hash with the recorded one. `tactus
// replay` and the determinism tests call it; it is not real time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "host_tools/replay/recorded_run.h"
#include "host_tools/replay/replayer.h"

namespace tactus::host {

// The outcome of a replay.
struct ReplayResult {
  // The number of the first tick that was replayed.
  std::uint64_t first_tick = 0;
  // How many ticks were replayed with equal hashes.
  std::uint64_t ticks = 0;
  // True if the recording lacks its end, because the recording program was cut off.
  bool cut = false;
  // The first difference, at which the replay stopped; empty if all ticks were equal.
  std::optional<Difference> difference;
};

// Receives the controller before the first tick.
using ReplayStart = std::function<void(firmware::Controller&)>;

// Receives the recorded tick after every tick that was equal.
using ReplaySink = std::function<void(const firmware::RecordedTick&)>;

// Replays from the beginning up to the first tick that differs. Throws InputError if the recording
// is damaged, a tick is missing in it, or it begins after tick 0 without the controller's state.
ReplayResult replay(RecordedRun& run, const ReplaySink& sink = {}, const ReplayStart& start = {});

// Replays a run of several devices, from a recording of each, in the order of the devices. `sink`
// gets the first device's ticks. Throws InputError, too, if one recording does not have the ticks
// of the first, or if one of them is of another run or is missing.
ReplayResult replay(std::span<RecordedRun* const> devices, const ReplaySink& sink = {},
                    const ReplayStart& start = {});

}  // namespace tactus::host
