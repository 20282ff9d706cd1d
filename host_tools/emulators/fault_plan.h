// Reads planned faults in the user's words: which axis fails, how and when. For `tactus emulate
// --fault`.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "host_tools/emulators/emulator_fault.h"

namespace tactus::host {

// A fault of a run.
struct PlannedFault {
  // The joint whose axis fails; all of them if not given.
  std::optional<std::size_t> joint;
  // `none` heals what was set before.
  EmulatorFault fault = EmulatorFault::none;
  // When it begins, s from the machine's start.
  double at_s = 0.0;
};

// Returns the fault of a text like "0:silent@3" or "all:none@3.5": a joint or `all`, a fault by its
// name in emulator_fault(), seconds. Throws InputError for any other text.
PlannedFault parse_planned_fault(std::string_view text);

}  // namespace tactus::host
