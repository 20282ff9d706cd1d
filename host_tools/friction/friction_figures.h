// Figures of friction: each experiment over the axes that show it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "host_tools/friction/experiments.h"

namespace tactus::host {

// Force over displacement for presliding and hysteresis, over velocity for lag, over the rate for
// break-away; position and forces over time for stick-slip and hunting. `model` is named in the
// title. Throws InputError when gnuplot is missing or fails.
void draw_experiment(const Experiment& experiment, const ExperimentRun& run,
                     const FrictionTrack& track, const std::filesystem::path& png);

// Force over displacement and over time. `title` names model and motion.
void draw_motion(const std::string& title, const FrictionTrack& track,
                 const std::filesystem::path& png);

// Position and forces over time.
void draw_push(const std::string& title, const FrictionTrack& track,
               const std::filesystem::path& png);

}  // namespace tactus::host
