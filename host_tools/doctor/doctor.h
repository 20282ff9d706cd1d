// `tactus doctor`: examines whether a machine can run the controller on time, and names the command
// that mends each fault. It changes nothing on the machine. The verb and its tests call it; not
// real time.
#pragma once

#include <string>

#include "host_tools/doctor/finding.h"
#include "host_tools/doctor/machine.h"
#include "host_tools/doctor/needs.h"

namespace tactus::host {

// Runs all checks and returns their findings: first the machine in the order of importance, then
// what the device needs.
Findings examine(Machine& machine, const Needs& needs);

// Returns the program's exit code: 0 if all is well (advice counts as well), 1 if something must be
// mended, 2 if nothing was seen to mend but something could not be looked at.
int exit_code(const Findings& findings);

// Returns one line a finding with its remedy on the line below, and a last line with the counts. A
// line fits into 80 columns unless the finding's text is long. With `colours`, for a terminal, the
// states have those of a traffic light.
std::string in_words(const Findings& findings, bool colours = false);

// Returns one JSON object a line, with the keys check, state, found and remedy.
std::string in_json(const Findings& findings);

}  // namespace tactus::host
