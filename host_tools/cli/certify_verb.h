// `tactus certify`: how stiff a surface a device can render and stay stable.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_certify_verb(CLI::App& app);

}  // namespace tactus::host
