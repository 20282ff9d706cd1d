// `tactus export`: writes a recording as a table for other programs.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in export/.
void add_export_verb(CLI::App& app);

}  // namespace tactus::host
