// `tactus emulate`: plays a whole haptic device from the other side of its bus.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb, with one verb for each device below it. The work is done in emulators/.
void add_emulate_verb(CLI::App& app);

}  // namespace tactus::host
