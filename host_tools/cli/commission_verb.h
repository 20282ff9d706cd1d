// `tactus commission`: the guided check of a device before its first force.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in commission/.
// Exit codes: 0 every joint passed, 1 one did not, 2 the device could not be tried.
void add_commission_verb(CLI::App& app);

}  // namespace tactus::host
