#include "hal/linux/counter_events.h"

#include <fcntl.h>
#include <linux/counter.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "hal/linux/sysfs_file.h"
#include "hal/linux/system.h"

namespace tactus::hal {

Result<FileDescriptor> watch_counter_index(const std::string& device, std::uint8_t count) {
  FileDescriptor descriptor(::open(device.c_str(), O_RDWR | O_CLOEXEC));
  if (!descriptor.is_open()) {
    return sysfs_failure(errno);
  }
  counter_watch watch{};
  watch.component.type = COUNTER_COMPONENT_COUNT;
  watch.component.scope = COUNTER_SCOPE_COUNT;
  watch.component.parent = count;
  watch.event = COUNTER_EVENT_INDEX;
  if (::ioctl(descriptor.get(), COUNTER_ADD_WATCH_IOCTL, &watch) != 0 ||
      ::ioctl(descriptor.get(), COUNTER_ENABLE_EVENTS_IOCTL) != 0) {
    const int why = errno;
    return why == ENOTTY ? failure(ErrorCode::not_supported, why) : sysfs_failure(why);
  }
  return descriptor;
}

Result<std::size_t> read_counter_index(int descriptor, std::span<CounterIndexEvent> events,
                                       TimeNs deadline_ns) {
  while (true) {
    if (!wait_readable(descriptor, deadline_ns)) {
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
