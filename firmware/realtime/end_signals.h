// Handles the signals that would end or stop the program: the force is taken away first. README.md
// has the table of all signals.
//
// The loop's thread or a library's thread receives the signals; helper threads block them
// (helper_thread.h). crash_stop.h handles crashes.
#pragma once

#include <csignal>
#include <cstdint>

namespace tactus::firmware {

enum class SignalReaction : std::uint8_t {
  end,       // the loop disables, the motors lose their torque, then the program ends
  crash,     // crash_stop.h: the motors lose their torque, then the signal has its own effect
  flight,    // the flight recorder writes its file
  ignore,    // ignored: the system call that failed reports the error
  harmless,  // the system's default is to ignore it
  uncaught,  // SIGKILL and SIGSTOP cannot be caught; the drives' own watchdogs act
};

// Returns the reaction to a signal from 1 to SIGRTMAX.
SignalReaction reaction_to(int signal);

// Sets it for all signals but the crashes. `on_end` and `on_flight` are called in whichever thread
// the signal finds, at any point of a tick. 0, or errno. Not real time.
int catch_end_signals(void (*on_end)(int), void (*on_flight)(int));

// After the motors have been stopped: a second signal ends a program that is slow to end.
void release_end_signals();

}  // namespace tactus::firmware
