#include "hal/linux/counter_events.h"

#include <fcntl.h>
#include <linux/counter.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "hal/linux/sysfs_file.h"

namespace tactus::hal {

namespace {

constexpr TimeNs kIndexNsPerSecond = 1'000'000'000;

TimeNs index_clock_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return TimeNs{now.tv_sec} * kIndexNsPerSecond + now.tv_nsec;
}

// Above 0: there is something to read; 0: the deadline passed; below: an error.
int wait_for_index(int descriptor, TimeNs deadline_ns) {
  while (true) {
    const TimeNs left_ns =
        deadline_ns == kNoWait ? 0 : std::max<TimeNs>(deadline_ns - index_clock_ns(), 0);
    const timespec left{.tv_sec = left_ns / kIndexNsPerSecond,
                        .tv_nsec = left_ns % kIndexNsPerSecond};
    pollfd watched{.fd = descriptor, .events = POLLIN, .revents = 0};
    const int ready = ::ppoll(&watched, 1, deadline_ns == kForever ? nullptr : &left, nullptr);
    if (ready >= 0 || errno != EINTR) {
      return ready;
    }
  }
}

}  // namespace

Result<int> watch_counter_index(const std::string& device, std::uint8_t count) {
  const int descriptor = ::open(device.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) {
    return sysfs_failure(errno);
  }
  counter_watch watch{};
  watch.component.type = COUNTER_COMPONENT_COUNT;
  watch.component.scope = COUNTER_SCOPE_COUNT;
  watch.component.parent = count;
  watch.event = COUNTER_EVENT_INDEX;
  if (::ioctl(descriptor, COUNTER_ADD_WATCH_IOCTL, &watch) != 0 ||
      ::ioctl(descriptor, COUNTER_ENABLE_EVENTS_IOCTL) != 0) {
    const int why = errno;
    ::close(descriptor);
    return why == ENOTTY ? failure(ErrorCode::not_supported, why) : sysfs_failure(why);
  }
  return descriptor;
}

Result<std::size_t> read_counter_index(int descriptor, std::span<CounterIndexEvent> events,
                                       TimeNs deadline_ns) {
  while (true) {
    const int ready = wait_for_index(descriptor, deadline_ns);
    if (ready < 0) {
      return sysfs_failure(errno);
    }
    if (ready == 0) {
      return failure(ErrorCode::timeout);
    }
    std::array<counter_event, 16> raw;
    const std::size_t wanted = std::min(raw.size(), events.size());
    const ssize_t length = ::read(descriptor, raw.data(), wanted * sizeof(counter_event));
    if (length < 0) {
      return sysfs_failure(errno);
    }
    if (length == 0) {
      return failure(ErrorCode::disconnected);
    }
    std::size_t count = 0;
    const std::size_t whole = static_cast<std::size_t>(length) / sizeof(counter_event);
    for (const counter_event& event : std::span(raw).first(whole)) {
      if (event.status == 0 && event.watch.event == COUNTER_EVENT_INDEX) {
        events[count] = {.count = event.value, .time_ns = static_cast<TimeNs>(event.timestamp)};
        ++count;
      }
    }
    if (count > 0) {
      return count;
    }
  }
}

}  // namespace tactus::hal
