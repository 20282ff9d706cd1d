// Figures of friction: each experiment over the axes that show it best. `tactus friction --figure`
// draws them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "host_tools/friction/experiments.h"

namespace tactus::host {

// Draws force over displacement for presliding and hysteresis, over velocity for lag, over the rate
// for break-away, and position and forces over time for stick-slip and hunting. Throws InputError
// if gnuplot is missing or fails.
void draw_experiment(const Experiment& experiment, const ExperimentRun& run,
                     const FrictionTrack& track, const std::filesystem::path& picture);

// Draws force over displacement and over time. `title` names model and motion. Throws InputError as
// draw_experiment() does.
void draw_motion(const std::string& title, const FrictionTrack& track,
                 const std::filesystem::path& picture);

// Draws position and forces over time. Throws InputError as draw_experiment() does.
void draw_push(const std::string& title, const FrictionTrack& track,
               const std::filesystem::path& picture);

}  // namespace tactus::host
