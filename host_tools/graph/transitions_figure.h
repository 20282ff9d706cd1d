// Draws the state machine of a run.
#pragma once

#include <filesystem>
#include <string>

#include "host_tools/graph/transitions.h"

namespace tactus::host {

// Draws the four states with their share of the ticks, and an arrow for each change that occurred,
// as thick as it was frequent, with its number. Throws InputError if gnuplot is missing or fails.
void draw_transitions(const Transitions& transitions, const std::string& title,
                      const std::filesystem::path& picture);

}  // namespace tactus::host
