// `tactus touch`: a tool path against a scene, without dynamics.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_touch_verb(CLI::App& app);

}  // namespace tactus::host
