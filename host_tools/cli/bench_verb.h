// `tactus bench`: how long a tick takes.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_bench_verb(CLI::App& app);

}  // namespace tactus::host
