// Takes the torque away when the program crashes. Afterwards the crash has its normal effect: a
// core dump and an exit by the signal, so that a service manager restarts the program.
//
// If the loop's thread crashes, the signal handler stops the motors. If another thread crashes, the
// handler waits for the loop, whose next tick is a fault (kLoopHelperCrashed). SIGKILL and a kernel
// that dies cannot be caught: the drives' own watchdogs and the watchdog output act then.
#pragma once

#include <array>
#include <csignal>
#include <cstddef>

namespace tactus::firmware {

// The stack on which a thread's crash handler runs, so that it also works after a stack overflow.
using CrashStack = std::array<std::byte, 16384>;

// Gives the calling thread that stack until the end of the scope. `stack` must outlive this.
class UseCrashStack {
 public:
  explicit UseCrashStack(CrashStack& stack);
  UseCrashStack(const UseCrashStack&) = delete;
  UseCrashStack& operator=(const UseCrashStack&) = delete;
  ~UseCrashStack();

  // Returns 0, or the errno with which the system refused the stack.
  [[nodiscard]] int error() const { return error_; }

 private:
  stack_t before_{};
  int error_ = 0;
};

// The signals that a thread's own instructions raise. SIGSYS is a system call that a sandbox
// forbids, SIGTRAP a breakpoint.
inline constexpr std::array kCrashSignals{SIGSEGV, SIGBUS,  SIGILL, SIGFPE,
                                          SIGABRT, SIGTRAP, SIGSYS};

// Returns all signals but kCrashSignals: the ones that a thread may block.
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
