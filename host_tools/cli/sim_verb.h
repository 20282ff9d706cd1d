// `tactus sim`: lets a simulated hand and device touch a scene through the real controller.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in simulation/.
void add_sim_verb(CLI::App& app);

}  // namespace tactus::host
