#include "hal/simulated/counter.h"

namespace tactus::hal {

void SimulatedCounter::move(std::int64_t steps) {
  if (steps == 0) {
    return;
  }
  direction_ = steps > 0 ? CountDirection::forward : CountDirection::backward;
  const auto way = static_cast<std::uint64_t>(steps > 0 ? steps : -steps);
  // The count wraps from the ceiling to 0 and back. The sums are arranged so that they cannot
  // overflow.
  if (steps > 0) {
    const std::uint64_t room = ceiling_now_ - count_;
    count_ = way <= room ? count_ + way : way - room - 1;
  } else {
    count_ = way <= count_ ? count_ - way : ceiling_now_ - (way - count_ - 1);
  }
}

void SimulatedCounter::pulse_index() {
  if (watches_index_ && !index_events_.full()) {
    index_events_.push({.count = count_, .time_ns = clock_.now_ns()});
  }
}

Result<std::uint64_t> SimulatedCounter::DoStart(const CounterConfig& config) {
  if (!present_) {
    return failure(ErrorCode::disconnected);
  }
  if (config.ceiling > hardware_ceiling_) {
    return failure(ErrorCode::not_supported);
  }
  ceiling_now_ = config.ceiling != 0 ? config.ceiling : hardware_ceiling_;
  count_ = count_ <= ceiling_now_ ? count_ : 0;
  watches_index_ = config.watch_index;
  index_events_.clear();
  return ceiling_now_;
}

Result<CounterReading> SimulatedCounter::DoRead() {
  if (!present_) {
    return failure(ErrorCode::disconnected);
  }
  return CounterReading{
      .count = count_, .time_ns = clock_.now_ns(), .direction = direction_, .noisy = noisy_};
}

Result<std::size_t> SimulatedCounter::DoReadIndex(std::span<CounterIndexEvent> events,
                                                  TimeNs deadline_ns) {
  clock_.wait_until(deadline_ns, [this] { return !index_events_.empty() || !present_; });
  if (!present_) {
    return failure(ErrorCode::disconnected);
  }
  std::size_t count = 0;
  while (count < events.size() && !index_events_.empty()) {
    events[count] = index_events_.front();
    index_events_.pop();
    ++count;
  }
  if (count == 0) {
    return failure(ErrorCode::timeout);
  }
  return count;
}

}  // namespace tactus::hal
