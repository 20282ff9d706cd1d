// The verb `line`: serves a board at the other end of a serial line to several programs.
#pragma once

#include <string>

#include "host_tools/cli/app_forward.h"
#include "host_tools/serial/line_gateway.h"

namespace tactus::host {

// Adds the verb with its options and examples to the command line. The work is done in serial/.
void add_line_verb(CLI::App& app);

// Runs a gateway until SIGINT or SIGTERM, or for so long if `seconds` is above 0, and prints what
// was recorded. Throws what LineGateway throws.
void run_gateway(LineGateway& gateway, double seconds, const std::string& record);

}  // namespace tactus::host
