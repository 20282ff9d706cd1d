// A simulated run with its files, as `tactus sim` and `tactus demo` make it.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "host_tools/cli/sim_outputs.h"
#include "host_tools/simulation/run.h"

namespace tactus::host {

// Runs a scene image to the end of its paths and writes the files. Returns the summary of each
// device. Warnings go to stderr, in the name of a verb. The caller has checked that no output is an
// input. Throws InputError.
std::vector<RunSummary> simulate(std::string_view verb, const std::filesystem::path& scene_file,
                                 const RunOptions& options, const SimFiles& files);

}  // namespace tactus::host
