// `tactus bench`: measures how long a tick takes, how late a loop wakes, and how fast a simulation
// runs.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in benchmark/.
void add_bench_verb(CLI::App& app);

}  // namespace tactus::host
