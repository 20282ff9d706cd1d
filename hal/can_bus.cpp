#include "hal/can_bus.h"

#include <algorithm>

namespace tactus::hal {

Result<std::size_t> CanBus::send(std::span<const CanFrame> frames) {
  if (frames.empty()) {
    return std::size_t{0};
  }
  if (!std::ranges::all_of(frames, is_valid)) {
    return failure(ErrorCode::invalid_argument);
  }
  if (!DoFdEnabled() && std::ranges::any_of(frames, &CanFrame::fd)) {
    // An interface without CAN FD cannot send the frame. The check is here so that every
    // implementation returns the same error.
    return failure(ErrorCode::not_supported);
  }
  const auto taken = DoSend(frames);
  if (taken) {
    counters_.sent += *taken;
    counters_.send_refused += frames.size() - *taken;
  } else if (taken.error().code == ErrorCode::queue_full) {
    counters_.send_refused += frames.size();
  }
  return taken;
}

Result<void> CanBus::send(const CanFrame& frame) {
  const auto taken = send(std::span(&frame, 1));
  if (!taken) {
    return std::unexpected(taken.error());
  }
  return {};
}

Result<std::size_t> CanBus::receive(std::span<CanReceived> received, TimeNs deadline_ns) {
  if (received.empty()) {
    return failure(ErrorCode::invalid_argument);
  }
  const auto count = DoReceive(received, deadline_ns);
  if (count) {
    const auto reports = static_cast<std::uint64_t>(
        std::ranges::count(received.first(*count), CanReceived::Kind::error, &CanReceived::kind));
    counters_.error_reports += reports;
    counters_.received += *count - reports;
  }
  return count;
}

Result<void> CanBus::set_filters(std::span<const CanFilter> filters) {
  if (filters.size() > kMaxCanFilters) {
    return failure(ErrorCode::invalid_argument);
  }
  return DoSetFilters(filters);
}

Result<void> CanBus::set_error_classes(std::uint32_t classes) {
  return DoSetErrorClasses(classes);
}

Result<void> CanBus::restart() {
  return DoRestart();
}

CanCounters CanBus::counters() const {
  CanCounters counters = counters_;
  counters.receive_dropped = DoReceiveDropped();
  return counters;
}

}  // namespace tactus::hal
