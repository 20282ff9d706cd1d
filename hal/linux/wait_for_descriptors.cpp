#include "hal/linux/wait_for_descriptors.h"

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace tactus::hal {

namespace {

constexpr TimeNs kNsPerSecond = 1'000'000'000;

}  // namespace

TimeNs monotonic_now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kNsPerSecond + now.tv_nsec;
}

int wait_for_descriptors(std::span<pollfd> descriptors, TimeNs deadline_ns) {
  for (;;) {
    const TimeNs left_ns =
        deadline_ns == kNoWait ? 0 : std::max<TimeNs>(0, deadline_ns - monotonic_now_ns());
    const timespec timeout{.tv_sec = left_ns / kNsPerSecond, .tv_nsec = left_ns % kNsPerSecond};
    const int ready = ppoll(descriptors.data(), descriptors.size(), &timeout, nullptr);
    if (ready >= 0 || errno != EINTR) {
      return ready;
    }
  }
}

}  // namespace tactus::hal
