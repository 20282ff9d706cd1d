// tactus replay: a recording lived once more, tick by tick, to the bit.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_replay_verb(CLI::App& app);

}  // namespace tactus::host
