#include "hal/linux/counter.h"

#include <utility>

#include "hal/linux/counter_events.h"

namespace tactus::hal {

namespace {

// Opens an attribute that not every driver has. Succeeds without opening it if it is missing.
Result<void> open_if_there(SysfsFile& file, const std::string& path) {
  const auto opened = file.open(path, SysfsFile::Use::read);
  return opened || opened.error().code == ErrorCode::not_found ? Result<void>{} : opened;
}

Result<CountDirection> direction_of(const SysfsFile& file) {
  std::array<char, 32> room;
  const auto line = file.read_line(room);
  if (!line) {
    return std::unexpected(line.error());
  }
  return *line == "forward"    ? CountDirection::forward
         : *line == "backward" ? CountDirection::backward
                               : CountDirection::unknown;
}

// Returns true if the counter reports noise. The attribute is a text such as "No excessive noise is
// present at the count inputs".
Result<bool> is_noisy(const SysfsFile& file) {
  std::array<char, 96> room;
  const auto line = file.read_line(room);
  if (!line) {
    return std::unexpected(line.error());
  }
  return !line->starts_with("No ") && *line != "0";
}

}  // namespace

Result<void> LinuxCounter::open(const CounterPlace& place) {
  if (count_.is_open()) {
    return failure(ErrorCode::invalid_state);
  }
  folder_ = std::string(place.root) + "/" + std::string(place.counter) + "/count" +
            std::to_string(place.count);
  device_ = std::string(place.device_root) + "/" + std::string(place.counter);
  number_ = static_cast<std::uint8_t>(place.count);
  if (const auto opened = open_if_there(direction_, folder_ + "/direction"); !opened) {
    return opened;
  }
  if (const auto opened = open_if_there(error_noise_, folder_ + "/error_noise"); !opened) {
    return opened;
  }
  return count_.open(folder_ + "/count", SysfsFile::Use::read);
}

// Sets an attribute if it exists and has another value.
Result<void> LinuxCounter::choose(const char* attribute, std::string_view value) const {
  SysfsFile file;
  const std::string path = folder_ + "/" + attribute;
  if (const auto readable = file.open(path, SysfsFile::Use::read); !readable) {
    return readable.error().code == ErrorCode::not_found ? Result<void>{} : readable;
  }
  std::array<char, 64> room;
  const auto now = file.read_line(room);
  if (!now) {
    return std::unexpected(now.error());
  }
  if (*now == value) {
    return {};
  }
  if (const auto writable = file.open(path, SysfsFile::Use::write); !writable) {
    return writable;
  }
  return file.write(value);
}

Result<std::uint64_t> LinuxCounter::set_ceiling(std::uint64_t wanted) const {
  SysfsFile file;
  if (!file.open(folder_ + "/ceiling", SysfsFile::Use::read)) {
    return wanted != 0 ? Result<std::uint64_t>(wanted) : failure(ErrorCode::not_supported);
  }
  if (wanted != 0) {
    if (const auto set = choose("ceiling", std::to_string(wanted)); !set) {
      return std::unexpected(set.error());
    }
  }
  const auto ceiling = file.read_number();
  if (ceiling && (*ceiling == 0 || (wanted != 0 && *ceiling != wanted))) {
    return failure(ErrorCode::not_supported);
  }
  return ceiling;
}

Result<void> LinuxCounter::configure() const {
  SysfsFile function;
  if (const auto there = function.open(folder_ + "/function", SysfsFile::Use::read); !there) {
    return there.error().code == ErrorCode::not_found ? failure(ErrorCode::not_supported) : there;
  }
  if (const auto set = choose("function", "quadrature x4"); !set) {
    return set;
  }
  return choose("enable", "1");
}

Result<std::uint64_t> LinuxCounter::DoStart(const CounterConfig& config) {
  if (!count_.is_open()) {
    return failure(ErrorCode::not_found);
  }
  events_.reset();
  if (config.ceiling != 0) {
    if (const auto set = choose("count_mode", "modulo-n"); !set) {
      return std::unexpected(set.error());
    }
  }
  const auto ceiling = set_ceiling(config.ceiling);
  if (!ceiling) {
    return ceiling;
  }
  if (const auto configured = configure(); !configured) {
    return std::unexpected(configured.error());
  }
  if (config.watch_index) {
    auto events = watch_counter_index(device_, number_);
    if (!events) {
      return failure(events.error().code == ErrorCode::not_found ? ErrorCode::not_supported
                                                                 : events.error().code,
                     events.error().errno_value);
    }
    events_ = std::move(*events);
  }
  return ceiling;
}

Result<CounterReading> LinuxCounter::DoRead() {
  CounterReading reading{.time_ns = monotonic_now_ns()};
  const auto count = count_.read_number();
  if (!count) {
    return std::unexpected(count.error());
  }
  reading.count = *count;
  if (direction_.is_open()) {
    const auto direction = direction_of(direction_);
    if (!direction) {
      return std::unexpected(direction.error());
    }
    reading.direction = *direction;
  }
  if (error_noise_.is_open()) {
    const auto noisy = is_noisy(error_noise_);
    if (!noisy) {
      return std::unexpected(noisy.error());
    }
    reading.noisy = *noisy;
  }
  return reading;
}

Result<std::size_t> LinuxCounter::DoReadIndex(std::span<CounterIndexEvent> events,
                                              TimeNs deadline_ns) {
  return read_counter_index(events_.get(), events, deadline_ns);
}

}  // namespace tactus::hal
