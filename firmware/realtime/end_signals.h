// The signals that end the program: every one that would end or stop a process takes the force away
// first. README.md has the table of all signals.
//
// A signal to the process reaches the loop's thread or a library's; helper threads leave signals to
// them (helper_thread.h). Crashes are crash_stop's.
#pragma once

#include <csignal>
#include <cstdint>

namespace tactus::firmware {

enum class SignalReaction : std::uint8_t {
  end,       // the loop disables, the motors are without torque, then the program ends
  crash,     // crash_stop.h: no torque, then the signal's own effect
  flight,    // the flight recorder is written out
  ignore,    // nothing: the call that failed says so
  harmless,  // nothing, by the system's own rule
  uncaught,  // SIGKILL, SIGSTOP: no program can; the drives' own watchdogs are for that
};

// The reaction to each signal from 1 to SIGRTMAX.
SignalReaction reaction_to(int signal);

// Sets it for all signals but the crashes. `on_end` and `on_flight` are called in whichever thread
// the signal finds, at any point of a tick. 0, or errno. Not real time.
int catch_end_signals(void (*on_end)(int), void (*on_flight)(int));

// After the motors have been stopped: a second signal ends a program that is slow to end.
void release_end_signals();

}  // namespace tactus::firmware
