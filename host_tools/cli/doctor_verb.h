// `tactus doctor`: whether this machine can run the controller on time.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_doctor_verb(CLI::App& app);

}  // namespace tactus::host
