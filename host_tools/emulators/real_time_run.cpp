#include "host_tools/emulators/real_time_run.h"

#include <fmt/format.h>
#include <poll.h>
#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <span>
#include <vector>

#include "hal/linux/clock.h"
#include "hal/linux/system.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Holds back the signals that end a run while it lives, so that nothing interrupts a step; came()
// asks for them.
class EndSignals {
 public:
  // Returns true if one of the signals has arrived; does not wait.
  [[nodiscard]] bool came() const {
    constexpr timespec kNoTime{};
    return sigtimedwait(&signals_, nullptr, &kNoTime) > 0;
  }

 private:
  static sigset_t int_and_term() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    return signals;
  }

  sigset_t signals_ = int_and_term();
  hal::SignalMask held_{SIG_BLOCK, signals_};
};

// Returns when the machine should run next, after it has slept until something arrived for a
// listener: a message is acted on at the next step, together with those that follow it closely.
hal::TimeNs next_wake_ns(std::span<pollfd> listeners, hal::TimeNs step_ns, hal::TimeNs latest_ns) {
  if (hal::wait_for_descriptors(listeners, latest_ns) <= 0) {
    return latest_ns;
  }
  return std::min(latest_ns, hal::next_instant_ns({.period_ns = step_ns}, hal::monotonic_now_ns()));
}

}  // namespace

void take_realtime_priority(int priority) {
  const sched_param parameters{.sched_priority = priority};
  if (sched_setscheduler(0, SCHED_FIFO, &parameters) != 0) {
    throw InputError(fmt::format(
        "--realtime {}: {}; run it as root, or allow it: rtprio in /etc/security/limits.conf",
        priority, std::strerror(errno)));
  }
}

hal::TimeNs start_of_run_ns(const RealTimeOptions& options) {
  return hal::next_instant_ns({.period_ns = options.step_ns}, hal::LinuxClock().now_ns());
}

void run_in_real_time(EmulatedRun& run, const RealTimeOptions& options, const RunStatusSink& sink) {
  // The status is reported each second. Signals are asked for every 5 ms only, since the question
  // is a system call.
  constexpr hal::TimeNs kSecond_ns = 1'000'000'000;
  constexpr hal::TimeNs kSignalPeriod_ns = 5'000'000;
  const EndSignals end_signals;
  hal::LinuxClock clock;
  const hal::TimeNs start_ns = run.next_step_ns();
  const hal::TimeNs end_ns =
      options.seconds ? start_ns + static_cast<hal::TimeNs>(*options.seconds * 1e9) : hal::kForever;
  hal::TimeNs next_status_ns = start_ns + kSecond_ns;
  hal::TimeNs next_signal_ns = start_ns;
  const bool listens = run.machine().only_listens();
  std::vector<pollfd> listeners;
  for (const int descriptor : run.machine().descriptors()) {
    listeners.push_back({.fd = descriptor, .events = POLLIN, .revents = 0});
  }
  // The messages that listeners send by their own clocks are due at whole periods after the start.
  constexpr hal::TimeNs kPeriod_ns = EmulatedRun::kListeningPeriod_ns;
  const hal::Phase phase = listens ? hal::Phase{kPeriod_ns, start_ns % kPeriod_ns}
                                   : hal::Phase{.period_ns = options.step_ns};
  hal::Wake wake = clock.sleep_until(start_ns);
  while (wake.scheduled_ns < end_ns) {
    run.run(wake.woke_ns, wake.scheduled_ns);
    if (wake.woke_ns >= next_status_ns) {
      sink(run);
      next_status_ns += kSecond_ns;
    }
    if (wake.woke_ns >= next_signal_ns) {
      if (end_signals.came()) {
        return;
      }
      next_signal_ns = wake.woke_ns + kSignalPeriod_ns;
    }
    const hal::TimeNs latest_ns =
        hal::next_instant_ns(phase, std::max(clock.now_ns(), wake.scheduled_ns));
    wake = clock.sleep_until(listens ? next_wake_ns(listeners, options.step_ns, latest_ns)
                                     : latest_ns);
  }
}

}  // namespace tactus::host
