#include "firmware/linux/realtime/real_time.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

namespace tactus::firmware {
namespace {

// Returns the exit code of `body` run in a process of its own: the test's process must not become a
// real-time one.
template <class Body>
int exit_code_of(Body body) {
  const pid_t child = fork();
  if (child == 0) {
    _exit(body());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(BecomeRealTime, SaysThatThereIsNoSuchProcessor) {
  const int code = exit_code_of([] {
    RealTimeError error;
    const bool done = become_real_time({.cpu = 1023}, error);
    return !done && error.errno_value == EINVAL && !error.what.empty() ? 0 : 1;
  });
  EXPECT_EQ(code, 0);
}

TEST(BecomeRealTime, RunsOnTheProcessorItWasGivenWhateverElseItMayNot) {
  cpu_set_t allowed;
  ASSERT_EQ(sched_getaffinity(0, sizeof(allowed), &allowed), 0);
  unsigned cpu = 0;
  while (!CPU_ISSET(cpu, &allowed)) {
    ++cpu;
  }
  const int code = exit_code_of([cpu] {
    RealTimeError error;
    (void)become_real_time({.cpu = static_cast<int>(cpu)}, error);
    cpu_set_t now;
    sched_getaffinity(0, sizeof(now), &now);
    return CPU_COUNT(&now) == 1 && CPU_ISSET(cpu, &now) ? 0 : 1;
  });
  EXPECT_EQ(code, 0);
}

// The child acts like an ordinary user without limits of its own.
TEST(BecomeRealTime, RefusesWithoutTheRightToIt) {
  const int code = exit_code_of([] {
    const rlimit none{};
    setrlimit(RLIMIT_RTPRIO, &none);
    setrlimit(RLIMIT_MEMLOCK, &none);
    if (getuid() == 0 && setuid(65534) != 0) {
      return 2;
    }
    RealTimeError error;
    return !become_real_time({}, error) && error.errno_value != 0 ? 0 : 1;
  });
  EXPECT_EQ(code, 0);
}

}  // namespace
}  // namespace tactus::firmware
