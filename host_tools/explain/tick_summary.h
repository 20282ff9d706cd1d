// The explanation of a tick as the live telemetry and recordings have it, from the whole one.
#pragma once

#include <string_view>

#include "firmware/telemetry/explanation.h"
#include "host_tools/explain/explained_tick.h"

namespace tactus::host {

// Returns the summary of a tick, with the time 0. firmware/telemetry/tick_explainer.h makes the
// same in the loop.
firmware::Explanation summary_of(const ExplainedTick& tick);

// Returns the name of the first field in which the two differ, but for the times; empty if there is
// none.
std::string_view first_difference(const firmware::Explanation& a, const firmware::Explanation& b);

}  // namespace tactus::host
