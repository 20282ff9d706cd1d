// A plan of faults: which axis fails, how and when, in a user's words.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "host_tools/emulators/can_emulator.h"

namespace tactus::host {

struct PlannedFault {
  std::optional<std::size_t> joint;  // nothing: every joint's axis
  EmulatorFault fault = EmulatorFault::none;
  double at_s = 0.0;  // since the machine's start
};

// "0:silent@3" or "all:none@3.5": joint or all, a fault (see emulator_fault), seconds. Throws
// InputError, text for a user, on anything else.
PlannedFault parse_planned_fault(std::string_view text);

}  // namespace tactus::host
