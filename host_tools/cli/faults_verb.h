// `tactus faults`: prints every fault and limit with its trigger, reaction and recovery.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in faults/.
void add_faults_verb(CLI::App& app);

}  // namespace tactus::host
