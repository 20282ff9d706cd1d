// tactus foxglove: a running controller, live, for Foxglove and PlotJuggler.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_foxglove_verb(CLI::App& app);

}  // namespace tactus::host
