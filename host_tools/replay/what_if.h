// Computes the force that the hand would have felt with other parameters during the recorded
// motion. The hand is not simulated; it would have moved otherwise.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host_tools/replay/recorded_run.h"

namespace tactus::host {

// `max_force_N=4` or `object.bunny.stiffness_N_per_m=300`, an object by its name in the scene or
// its number. Throws InputError.
firmware::ParameterChange parse_change(std::string_view text, const rendering::SceneImage* scene);

// One tick, both ways.
struct WhatIfTick {
  double time_s = 0.0;
  Vec3 recorded_W = Vec3::Zero();  // N, commanded
  Vec3 changed_W = Vec3::Zero();
};

struct WhatIfSummary {
  std::uint64_t ticks = 0;
  double most_recorded_N = 0.0;
  double most_changed_N = 0.0;
  double mean_recorded_N = 0.0;  // over the ticks in which either is felt
  double mean_changed_N = 0.0;
  double most_apart_N = 0.0;      // of the difference of the two
  double most_apart_s = 0.0;      // when
  std::optional<double> fault_s;  // the changed run ends in a fault where the recorded one does not
  std::optional<double> scene_changed_s;  // no further than here: what was set was of another scene
};

using WhatIfSink = std::function<void(const WhatIfTick&)>;

// Replays from the recording's start, or from the state in it, to its end or to its first change of
// scene. The run's own changes of the same parameters are left out. Throws InputError if the
// controller refuses a change.
WhatIfSummary what_if(RecordedRun& run, std::span<const firmware::ParameterChange> changes,
                      const WhatIfSink& sink);

}  // namespace tactus::host
