// Computes the force that the hand would have felt with other parameters, for the recorded motion.
// The hand is not simulated: with another force it would have moved otherwise. `tactus replay
// --set` calls it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host_tools/replay/recorded_run.h"

namespace tactus::host {

// Returns the change that a text like `max_force_N=4` or `object.bunny.stiffness_N_per_m=300` asks
// for; an object is given by its name in the scene or its number. Throws InputError for an unknown
// parameter or object and for a value that is not a finite number. `scene` may be nullptr.
firmware::ParameterChange parse_change(std::string_view text, const rendering::SceneImage* scene);

// The commanded force of one tick, as recorded and with the changed parameters. World frame.
struct WhatIfTick {
  // The time of the run, s.
  double time_s = 0.0;
  // N, after the safety limits.
  Vec3 recorded_W = Vec3::Zero();
  // N, after the safety limits.
  Vec3 changed_W = Vec3::Zero();
};

// The differences that a what-if replay found over all of its ticks.
struct WhatIfSummary {
  // How many ticks were replayed.
  std::uint64_t ticks = 0;
  // The largest commanded force of either run, N.
  double most_recorded_N = 0.0;
  double most_changed_N = 0.0;
  // Means over the ticks in which at least one of the two forces is not zero, N.
  double mean_recorded_N = 0.0;
  double mean_changed_N = 0.0;
  // The largest length of the difference of the two force vectors, N, and the time of it.
  double most_apart_N = 0.0;
  double most_apart_s = 0.0;
  // When the changed run went into a fault while the recorded one did not; empty if it never did.
  std::optional<double> fault_s;
  // When the recorded run changed its scene, which ends the replay: the parameters that were set
  // belong to the scene before. Empty if it kept its scene.
  std::optional<double> scene_changed_s;
};

// Receives every replayed tick.
using WhatIfSink = std::function<void(const WhatIfTick&)>;

// Replays with `changes` applied before the first tick, from the recording's beginning to its end
// or to its first change of scene. Changes that the run itself made to the same parameters are left
// out. Throws InputError if the controller refuses a change.
WhatIfSummary what_if(RecordedRun& run, std::span<const firmware::ParameterChange> changes,
                      const WhatIfSink& sink);

}  // namespace tactus::host
