// `tactus certify`: finds out how stiff a surface a device can render and stay stable.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in certify/.
void add_certify_verb(CLI::App& app);

}  // namespace tactus::host
