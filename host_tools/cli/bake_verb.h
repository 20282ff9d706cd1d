// `tactus bake`: turns a scene or a device file into the image that the controller reads.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in bake/.
void add_bake_verb(CLI::App& app);

}  // namespace tactus::host
