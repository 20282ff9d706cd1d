// `tactus demo`: everything once, from a scene to pictures of a touch.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its examples to the command line. The work is that of bake, sim and plot.
void add_demo_verb(CLI::App& app);

}  // namespace tactus::host
