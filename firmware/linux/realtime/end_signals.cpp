#include "firmware/linux/realtime/end_signals.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>

#include "firmware/linux/realtime/crash_stop.h"

namespace tactus::firmware {
namespace {

// The C library reserves these two signals (pthread_cancel, setuid), and its sigaction refuses
// them. The program uses neither, so it sets them with the kernel's call.
constexpr int kLibraryCancel = 32;
constexpr int kLibrarySetId = 33;

// Returns true for a signal that the C library keeps for itself.
constexpr bool is_the_librarys(int signal) {
  return signal == kLibraryCancel || signal == kLibrarySetId;
}

// Ignores the signal by the kernel's call. Its argument is handler, flags, restorer and mask; all
// but the handler SIG_IGN are zero.
void ignore_in_kernel(int signal) {
  constexpr std::size_t kMask_bytes = 8;
  struct {
    void (*handler)(int) = SIG_IGN;
    std::array<unsigned long, 4> rest{};
  } action;
  // The C library has no wrapper for this call.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  (void)syscall(SYS_rt_sigaction, signal, &action, nullptr, kMask_bytes);
}

// Sets the handler of one signal. Returns 0 or errno.
int set_handler(int signal, void (*handler)(int)) {
  struct sigaction action{};
  action.sa_handler = handler;
  return sigaction(signal, &action, nullptr) == 0 ? 0 : errno;
}

}  // namespace

SignalReaction reaction_to(int signal) {
  if (std::ranges::find(kCrashSignals, signal) != kCrashSignals.end()) {
    return SignalReaction::crash;
  }
  switch (signal) {
    case SIGKILL:
    case SIGSTOP:
      return SignalReaction::uncaught;
    case SIGUSR1:
      return SignalReaction::flight;
    case SIGPIPE:
      return SignalReaction::ignore;
    case SIGCHLD:
    case SIGCONT:
    case SIGURG:
    case SIGWINCH:
      return SignalReaction::harmless;
    default:
      return is_the_librarys(signal) ? SignalReaction::ignore : SignalReaction::end;
  }
}

int catch_end_signals(void (*on_end)(int), void (*on_flight)(int)) {
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    int failed = 0;
    switch (reaction_to(signal)) {
      case SignalReaction::end:
        failed = set_handler(signal, on_end);
        break;
      case SignalReaction::flight:
        failed = set_handler(signal, on_flight);
        break;
      case SignalReaction::ignore:
        if (is_the_librarys(signal)) {
          ignore_in_kernel(signal);
        } else {
          failed = set_handler(signal, SIG_IGN);
        }
        break;
      default:
        break;
    }
    if (failed != 0) {
      return failed;
    }
  }
  // The parent process may have blocked some signals.
  sigset_t all;
  sigfillset(&all);
  return pthread_sigmask(SIG_UNBLOCK, &all, nullptr);
}

void release_end_signals() {
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    if (reaction_to(signal) == SignalReaction::end) {
      // Terminal output in the background, or to a terminal that has gone, must not stop the
      // program.
      const bool is_the_terminals = signal == SIGTTOU || signal == SIGTTIN || signal == SIGTSTP;
      (void)set_handler(signal, is_the_terminals ? SIG_IGN : SIG_DFL);
    }
  }
}

}  // namespace tactus::firmware
