// Handles the signals that would end or stop the program: the force is taken away first. README.md
// has the table of all signals.
//
// The loop's thread or a library's thread receives the signals; helper threads block them
// (helper_thread.h). crash_stop.h handles crashes.
#pragma once

#include <csignal>
#include <cstdint>

namespace tactus::firmware {

// The reactions to signals.
enum class SignalReaction : std::uint8_t {
  // The loop disables, the motors lose their torque, then the program ends.
  end,
  // The motors lose their torque, then the signal has its own effect (crash_stop.h).
  crash,
  // The flight recorder writes its file.
  flight,
  // The signal is ignored: the system call that failed reports the error.
  ignore,
  // The system's default is to ignore it.
  harmless,
  // SIGKILL and SIGSTOP cannot be caught; the drives' own watchdogs act.
  uncaught,
};

// Returns the reaction to a signal from 1 to SIGRTMAX.
SignalReaction reaction_to(int signal);

// Installs the reactions to all signals but crashes. Any thread may call `on_end` and `on_flight`,
// at any point of a tick. Returns 0 or errno. Not real time.
int catch_end_signals(void (*on_end)(int), void (*on_flight)(int));

// Restores the default effect of the end signals, so that a second one ends a program that is slow
// to end. Call after the motors have been stopped.
void release_end_signals();

}  // namespace tactus::firmware
