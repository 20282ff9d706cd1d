// `tactus inspect`: what is in a scene image.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_inspect_verb(CLI::App& app);

}  // namespace tactus::host
