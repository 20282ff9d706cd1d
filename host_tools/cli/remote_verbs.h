// The verbs that send a command to a running controller: home, enable, disable, reset, estop,
// status, get, set, scene, record, inject.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verbs with their options and examples to the command line. The work is done in remote/.
void add_remote_verbs(CLI::App& app);

// Thrown when the controller refuses. The reply has been printed already; main only returns the
// exit code.
struct Refused {};

}  // namespace tactus::host
