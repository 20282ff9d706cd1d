// Runs an emulated machine against the monotonic clock of this machine. `tactus emulate` uses it.
#pragma once

#include <functional>
#include <optional>

#include "hal/clock.h"
#include "host_tools/emulators/emulated_run.h"

namespace tactus::host {

// How long, and in which steps.
struct RealTimeOptions {
  // The length of the run; without it the run lasts until SIGINT or SIGTERM.
  std::optional<double> seconds;
  hal::TimeNs step_ns = kLongestMachineStep_ns;
};

// Gives this thread, and those that it starts later, a SCHED_FIFO priority from 1 to 99. Throws
// InputError if the system refuses.
void take_realtime_priority(int priority);

// Returns when a machine that is about to be made should start: the next instant of the loop's
// phase.
hal::TimeNs start_of_run_ns(const RealTimeOptions& options);

// Is called once a second of the run.
using RunStatusSink = std::function<void(const EmulatedRun&)>;

// Runs until the time is over or a signal ends the program. A machine whose devices all listen
// sleeps until something arrives for one of them or EmulatedRun::kListeningPeriod_ns is over, and
// makes the steps up to then; any other wakes for each step.
void run_in_real_time(EmulatedRun& run, const RealTimeOptions& options, const RunStatusSink& sink);

}  // namespace tactus::host
