// `tactus doctor`: says whether this machine can run the controller on time.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in doctor/.
// Exit codes: 0 all well, 1 something to mend, 2 something could not be looked at.
void add_doctor_verb(CLI::App& app);

}  // namespace tactus::host
