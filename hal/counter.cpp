#include "hal/counter.h"

namespace tactus::hal {

// Unsigned arithmetic wraps at 2^64, so the computation is right for every ceiling.
std::int64_t count_difference(std::uint64_t from, std::uint64_t to, std::uint64_t ceiling) {
  const std::uint64_t up = to >= from ? to - from : to - from + ceiling + 1;
  const std::uint64_t down = to <= from ? from - to : from - to + ceiling + 1;
  return up <= down ? static_cast<std::int64_t>(up) : -static_cast<std::int64_t>(down);
}

Result<void> Counter::start(const CounterConfig& config) {
  ceiling_ = 0;
  watches_index_ = false;
  const auto ceiling = DoStart(config);
  if (!ceiling) {
    return std::unexpected(ceiling.error());
  }
  ceiling_ = *ceiling;
  watches_index_ = config.watch_index;
  return {};
}

Result<CounterReading> Counter::read() {
  if (ceiling_ == 0) {
    return failure(ErrorCode::invalid_state);
  }
  const auto reading = DoRead();
  // A count above the ceiling would make count_difference return nonsense.
  if (reading && reading->count > ceiling_) {
    return failure(ErrorCode::io);
  }
  return reading;
}

Result<std::size_t> Counter::read_index(std::span<CounterIndexEvent> events, TimeNs deadline_ns) {
  if (ceiling_ == 0 || !watches_index_) {
    return failure(ErrorCode::invalid_state);
  }
  if (events.empty()) {
    return failure(ErrorCode::invalid_argument);
  }
  return DoReadIndex(events, deadline_ns);
}

}  // namespace tactus::hal
