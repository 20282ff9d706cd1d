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

// Catches kCrashSignals in all threads. Call from the loop's thread, before there is torque. The
// handler may call `stop_motors` at any point of a tick; if it hangs, an alarm ends the program
// after a second. Returns 0 or errno.
int catch_crashes(void (*stop_motors)());

// Returns true if a thread other than the loop's has crashed. Real time.
bool has_helper_crashed();

// Ends the program by the signal of the crashed thread. Call only after has_helper_crashed() and
// after the motors have been stopped.
[[noreturn]] void end_in_crash();

}  // namespace tactus::firmware
