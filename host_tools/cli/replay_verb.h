// `tactus replay`: repeats a recorded run tick by tick, and compares every hash.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in replay/.
// Exit codes: 0 every tick is equal, 1 one differs, 2 the run could not be replayed.
void add_replay_verb(CLI::App& app);

}  // namespace tactus::host
