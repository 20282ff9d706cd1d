#include "hal/linux/system.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace tactus::hal {

// A 32-bit board's seconds have 32 bits; its clock, which begins at the start, does not reach their
// end.
timespec to_timespec(TimeNs time_ns) {
  return {.tv_sec = static_cast<decltype(timespec::tv_sec)>(time_ns / kNsPerSecond),
          .tv_nsec = static_cast<decltype(timespec::tv_nsec)>(time_ns % kNsPerSecond)};
}

TimeNs to_ns(const timespec& time) {
  return (time.tv_sec * kNsPerSecond) + time.tv_nsec;
}

TimeNs monotonic_now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return to_ns(now);
}

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  if (this != &other) {
    reset();
    descriptor_ = std::exchange(other.descriptor_, -1);
  }
  return *this;
}

void FileDescriptor::reset() {
  if (descriptor_ >= 0) {
    close(descriptor_);
    descriptor_ = -1;
  }
}

int wait_for_descriptors(std::span<pollfd> descriptors, TimeNs deadline_ns) {
  while (true) {
    const TimeNs left_ns =
        deadline_ns == kNoWait ? 0 : std::max<TimeNs>(0, deadline_ns - monotonic_now_ns());
    const timespec left = to_timespec(left_ns);
    const int ready = ppoll(descriptors.data(), descriptors.size(), &left, nullptr);
    if (ready >= 0 || errno != EINTR) {
      return ready;
    }
  }
}

bool wait_readable(int descriptor, TimeNs deadline_ns) {
  pollfd wanted{.fd = descriptor, .events = POLLIN, .revents = 0};
  // If the wait failed, the read that follows reports the error.
  return wait_for_descriptors({&wanted, 1}, deadline_ns) != 0;
}

}  // namespace tactus::hal
