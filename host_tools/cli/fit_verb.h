// `tactus fit`: estimates the parameters of friction models from a measured record.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in friction/.
void add_fit_verb(CLI::App& app);

}  // namespace tactus::host
