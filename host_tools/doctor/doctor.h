// Checks that a machine can run the controller on time, and says how to mend what prevents it.
#pragma once

#include <string>

#include "host_tools/doctor/finding.h"
#include "host_tools/doctor/machine.h"
#include "host_tools/doctor/needs.h"

namespace tactus::host {

// Everything that matters to a device with these needs, in the order of importance.
Findings examine(Machine& machine, const Needs& needs);

// 0 all well (advice is well), 1 something to mend, 2 nothing to mend was seen but something could
// not be looked at.
int exit_code(const Findings& findings);

// A line a finding, its remedy on a line of its own below; and a last line with the count. Lines
// of what was found fit into 80 columns unless a finding is long.
std::string in_words(const Findings& findings);

// A JSON object a line.
std::string in_json(const Findings& findings);

}  // namespace tactus::host
