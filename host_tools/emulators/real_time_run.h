// Runs an emulated machine against the monotonic clock of this machine.
#pragma once

#include <functional>
#include <optional>

#include "hal/clock.h"
#include "host_tools/emulators/emulated_run.h"

namespace tactus::host {

struct RealTimeOptions {
  std::optional<double> seconds;  // nothing: until SIGINT or SIGTERM
  hal::TimeNs step_ns = kLongestMachineStep_ns;
};

// Gives this thread, and those that it starts from now on, a SCHED_FIFO priority from 1 to 99.
// Throws InputError, text for a user, where the system refuses.
void take_realtime_priority(int priority);

// Returns when a machine that is about to be made should start: an instant of the loop's phase.
hal::TimeNs start_of_run_ns(const RealTimeOptions& options);

// Called once a second of the run.
using RunStatusSink = std::function<void(const EmulatedRun&)>;

// Returns when the time is over or the user ends the program.
void run_in_real_time(EmulatedRun& run, const RealTimeOptions& options, const RunStatusSink& sink);

}  // namespace tactus::host
