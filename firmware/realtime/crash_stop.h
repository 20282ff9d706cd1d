// A crash anywhere in the program leaves motors without torque behind, and then takes its course:
// a core dump, and the signal as the exit status by which a service manager starts anew.
//
// One in the loop's thread stops the motors from within the signal's handler. One in a thread
// beside it waits in the handler for the loop, whose next tick is a fault (kLoopHelperCrashed).
// What no program can catch, SIGKILL and a kernel that dies, is left to the drives' own watchdogs
// and to the watchdog output.
#pragma once

#include <array>
#include <csignal>
#include <cstddef>

namespace tactus::firmware {

// A thread whose own stack has run over has this one for the handler. Outlives its use.
using CrashStack = std::array<std::byte, 16384>;

// Gives the calling thread that stack, from here to the end of the scope.
class UseCrashStack {
 public:
  explicit UseCrashStack(CrashStack& stack);
  UseCrashStack(const UseCrashStack&) = delete;
  UseCrashStack& operator=(const UseCrashStack&) = delete;
  ~UseCrashStack();

  [[nodiscard]] int error() const { return error_; }  // 0, or errno: there is none

 private:
  stack_t before_{};
  int error_ = 0;
};

// Signals that a thread's own instructions raise. A system call that a sandbox forbids is SIGSYS, a
// breakpoint SIGTRAP.
inline constexpr std::array kCrashSignals{SIGSEGV, SIGBUS,  SIGILL, SIGFPE,
                                          SIGABRT, SIGTRAP, SIGSYS};

// What a thread may block.
sigset_t all_signals_but_crashes();

// Catches kCrashSignals of every thread. From the loop's thread.
// `stop_motors` may be called at any point of a tick; should it hang, the program ends after a
// second all the same. 0, or errno.
int catch_crashes(void (*stop_motors)());

// Real time.
bool has_helper_crashed();

// Lets the crashed thread, and the program with it, end: the motors are without torque. Only where
// has_helper_crashed().
[[noreturn]] void end_in_crash();

}  // namespace tactus::firmware
