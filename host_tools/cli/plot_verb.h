// `tactus plot`: draws figures of a run.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in plot/.
void add_plot_verb(CLI::App& app);

}  // namespace tactus::host
