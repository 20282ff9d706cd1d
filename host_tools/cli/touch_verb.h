// `tactus touch`: moves a tool along given positions through a scene, without dynamics.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line.
void add_touch_verb(CLI::App& app);

}  // namespace tactus::host
