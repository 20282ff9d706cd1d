// `tactus fit`: the parameters of friction models from a measured record.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_fit_verb(CLI::App& app);

}  // namespace tactus::host
