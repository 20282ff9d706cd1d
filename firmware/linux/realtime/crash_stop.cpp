#include "firmware/linux/realtime/crash_stop.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <ctime>

namespace tactus::firmware {
namespace {

// The longest time in which the handler may stop the motors. Then an uncaught alarm ends the
// program.
constexpr unsigned kMostStop_s = 1;
// The longest time that a crashed helper thread waits for the loop to stop the motors.
constexpr int kMostWait_ms = 1000;

// The variables that the signal handler uses.
void (*stop_motors)() = nullptr;
pid_t loop_thread = 0;
// Words, 1 for true: RISC-V has no atomic bytes.
std::atomic<int> helper_crashed{0};
std::atomic<int> motors_stopped{0};
static_assert(std::atomic<int>::is_always_lock_free);

// Sets the handler of all crashes. It runs on the thread's crash stack.
int set_handler(void (*handler)(int)) {
  struct sigaction action{};
  action.sa_handler = handler;
  action.sa_flags = SA_ONSTACK;
  for (const int crash : kCrashSignals) {
    if (sigaction(crash, &action, nullptr) != 0) {
      return errno;
    }
  }
  return 0;
}

// Starts an alarm that ends the program. It resets SIGALRM's handler, which would only ask the loop
// to end.
void set_alarm() {
  sigset_t alarm_only;
  sigemptyset(&alarm_only);
  sigaddset(&alarm_only, SIGALRM);
  struct sigaction action{};
  action.sa_handler = SIG_DFL;
  sigaction(SIGALRM, &action, nullptr);
  pthread_sigmask(SIG_UNBLOCK, &alarm_only, nullptr);
  alarm(kMostStop_s);
}

// Tells the loop of the crash and waits until it has stopped the motors. It polls, because no lock
// is safe in a signal handler.
void wait_for_the_loop() {
  constexpr timespec kMillisecond{.tv_sec = 0, .tv_nsec = 1'000'000};
  helper_crashed.store(1, std::memory_order_relaxed);
  for (int i = 0; i < kMostWait_ms && motors_stopped.load(std::memory_order_acquire) == 0; ++i) {
    nanosleep(&kMillisecond, nullptr);
  }
}

// The handler. It is async-signal-safe except for the driver's own stop. It raises the signal
// again, which has its default effect after the handler has returned.
void on_crash(int crash) {
  if (gettid() == loop_thread) {
    set_handler(SIG_DFL);
    set_alarm();
    stop_motors();
  } else {
    wait_for_the_loop();
    set_handler(SIG_DFL);
  }
  raise(crash);
}

}  // namespace

UseCrashStack::UseCrashStack(CrashStack& stack) {
  const stack_t own{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
  error_ = sigaltstack(&own, &before_) == 0 ? 0 : errno;
}

UseCrashStack::~UseCrashStack() {
  if (error_ == 0) {
    sigaltstack(&before_, nullptr);
  }
}

sigset_t all_signals_but_crashes() {
  sigset_t signals;
  sigfillset(&signals);
  for (const int crash : kCrashSignals) {
    sigdelset(&signals, crash);
  }
  return signals;
}

int catch_crashes(void (*stop)()) {
  static CrashStack stack;
  static const UseCrashStack in_use(stack);
  stop_motors = stop;
  loop_thread = gettid();
  return in_use.error() != 0 ? in_use.error() : set_handler(on_crash);
}

bool has_helper_crashed() {
  return helper_crashed.load(std::memory_order_relaxed) != 0;
}

void end_in_crash() {
  motors_stopped.store(1, std::memory_order_release);
  // The crashed thread raises its signal again when it sees motors_stopped, and that ends the
  // program.
  for (;;) {
    pause();
  }
}

}  // namespace tactus::firmware
