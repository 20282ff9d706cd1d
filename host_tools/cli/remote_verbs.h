// The verbs that speak with a running controller: `tactus enable`, `tactus set` and their like.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_remote_verbs(CLI::App& app);

// Leaves main with the exit code of a refusal, which has been told already.
struct Refused {};

}  // namespace tactus::host
