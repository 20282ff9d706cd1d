// `tactus inspect`: checks a scene image and shows what is in it.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line.
void add_inspect_verb(CLI::App& app);

}  // namespace tactus::host
