// `tactus friction`: a friction model on a motion, on a mass, or in an experiment.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_friction_verb(CLI::App& app);

}  // namespace tactus::host
