// `tactus deploy`: brings packages and images to a board.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in deploy/.
void add_deploy_verb(CLI::App& app);

}  // namespace tactus::host
