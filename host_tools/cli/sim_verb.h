// `tactus sim`: a simulated hand and device touch a scene through the real controller.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_sim_verb(CLI::App& app);

}  // namespace tactus::host
