// `tactus compare`: one path over one scene by several methods.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb to the app.
void add_compare_verb(CLI::App& app);

}  // namespace tactus::host
