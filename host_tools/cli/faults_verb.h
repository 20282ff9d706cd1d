// `tactus faults`: every fault and limit, its trigger, reaction and recovery.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_faults_verb(CLI::App& app);

}  // namespace tactus::host
