// The verb `flash`: writes a program to a board, or runs it in an emulator.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in flash/.
void add_flash_verb(CLI::App& app);

}  // namespace tactus::host
