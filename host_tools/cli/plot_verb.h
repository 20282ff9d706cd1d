// `tactus plot`: figures of a run.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_plot_verb(CLI::App& app);

}  // namespace tactus::host
