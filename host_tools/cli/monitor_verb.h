// `tactus monitor` and `tactus watch`: a running controller on a terminal, and as lines of text.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Each adds its verb with options and examples to the command line. The work is done in monitor/.
void add_monitor_verb(CLI::App& app);
void add_watch_verb(CLI::App& app);

}  // namespace tactus::host
