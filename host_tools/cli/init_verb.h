// The verb `tactus init`.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_init_verb(CLI::App& app);

}  // namespace tactus::host
