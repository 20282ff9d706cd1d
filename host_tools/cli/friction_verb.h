// `tactus friction`: runs a friction model on a motion, on a pushed mass, or in an experiment.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in friction/.
void add_friction_verb(CLI::App& app);

}  // namespace tactus::host
