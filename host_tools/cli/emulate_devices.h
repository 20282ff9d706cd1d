// The devices of `tactus emulate`, each a verb of its own below it.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds odrive, moteus, cia402 and vesc.
void add_emulated_can_devices(CLI::App& emulate);
// Adds falcon, haply and paddle.
void add_emulated_boards(CLI::App& emulate);

}  // namespace tactus::host
