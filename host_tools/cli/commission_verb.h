// `tactus commission`: the guided check of a device before its first force.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_commission_verb(CLI::App& app);

}  // namespace tactus::host
