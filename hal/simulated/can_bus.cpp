#include "hal/simulated/can_bus.h"

#include <algorithm>

namespace tactus::hal {

namespace {

// The thresholds of fault confinement in ISO 11898-1.
constexpr std::uint32_t kWarningThreshold = 96;
constexpr std::uint32_t kPassiveThreshold = 128;
constexpr std::uint32_t kBusOffThreshold = 256;
// The cost of a failed transmission in counts; a good one takes back one count.
constexpr std::uint32_t kCostOfAFailure = 8;

// Returns the counter as CanStatus shows it.
std::uint8_t saturated(std::uint32_t counter) {
  return static_cast<std::uint8_t>(std::min<std::uint32_t>(counter, 255));
}

}  // namespace

SimulatedCanBus::SimulatedCanBus(SimulatedCanNetwork& network, const SimulatedCanBusConfig& config)
    : network_(network), config_(config) {
  config_.send_capacity = std::min(config_.send_capacity, kMaxSendQueue);
  config_.receive_capacity = std::min(config_.receive_capacity, kMaxReceiveQueue);
  network_.attach(*this);
}

SimulatedCanBus::~SimulatedCanBus() {
  network_.detach(*this);
}

Result<std::size_t> SimulatedCanBus::DoSend(std::span<const CanFrame> frames) {
  if (!present_) {
    return failure(ErrorCode::disconnected);
  }
  if (!up_) {
    return failure(ErrorCode::link_down);
  }
  if (state_ == CanState::bus_off) {
    return failure(ErrorCode::bus_off);
  }
  std::size_t taken = 0;
  for (const CanFrame& frame : frames) {
    if (send_queue_.size() == config_.send_capacity) {
      break;
    }
    send_queue_.push(frame);
    ++taken;
    network_.serve();
  }
  if (taken == 0) {
    return failure(ErrorCode::queue_full);
  }
  return taken;
}

Result<std::size_t> SimulatedCanBus::DoReceive(std::span<CanReceived> received,
                                               TimeNs deadline_ns) {
  network_.clock().wait_until(deadline_ns,
                              [this] { return !receive_queue_.empty() || !up_ || !present_; });
  std::size_t count = 0;
  while (count < received.size() && !receive_queue_.empty()) {
    received[count] = receive_queue_.front();
    receive_queue_.pop();
    ++count;
  }
  if (count > 0) {
    return count;
  }
  if (!present_) {
    return failure(ErrorCode::disconnected);
  }
  return failure(up_ ? ErrorCode::timeout : ErrorCode::link_down);
}

Result<void> SimulatedCanBus::DoSetFilters(std::span<const CanFilter> filters) {
  if (!present_) {
    return failure(ErrorCode::disconnected);
  }
  std::ranges::copy(filters, filters_.begin());
  filter_count_ = filters.size();
  return {};
}

Result<void> SimulatedCanBus::DoSetErrorClasses(std::uint32_t classes) {
  if (!present_) {
    return failure(ErrorCode::disconnected);
  }
  error_classes_ = classes;
  return {};
}

Result<void> SimulatedCanBus::DoRestart() {
  if (!present_) {
    return failure(ErrorCode::disconnected);
  }
  if (!up_) {
    return failure(ErrorCode::link_down);
  }
  if (state_ != CanState::bus_off) {
    return failure(ErrorCode::invalid_state);
  }
  transmit_errors_ = 0;
  state_ = CanState::error_active;
  inject_error({.classes = kCanRestarted});
  return {};
}

CanStatus SimulatedCanBus::DoStatus() const {
  return {.state = up_ && present_ ? state_ : CanState::stopped,
          .transmit_errors = saturated(transmit_errors_),
          .receive_errors = 0};
}

void SimulatedCanBus::set_link_up(bool up) {
  up_ = up;
  if (up) {
    transmit_errors_ = 0;
    state_ = CanState::error_active;
  } else {
    send_queue_.clear();
    network_.abandon(*this);
  }
}

void SimulatedCanBus::remove_interface() {
  set_link_up(false);
  present_ = false;
}

void SimulatedCanBus::force_bus_off() {
  transmit_errors_ = kBusOffThreshold;
  update_state();
}

void SimulatedCanBus::inject_error(const CanErrorReport& report) {
  if ((report.classes & error_classes_) != 0 && up_) {
    CanReceived item;
    item.kind = CanReceived::Kind::error;
    item.error = report;
    item.time_ns = network_.clock().now_ns();
    enqueue(item);
  }
}

void SimulatedCanBus::fail_transmissions(std::uint32_t count) {
  failing_ = count;
}

bool SimulatedCanBus::transmission_fails() {
  if (failing_ == 0) {
    return false;
  }
  --failing_;
  transmit_errors_ += kCostOfAFailure;
  inject_error({.classes = kCanProtocol | kCanBusError | kCanErrorCounters,
                .transmit_errors = saturated(transmit_errors_)});
  update_state();
  return true;
}

void SimulatedCanBus::note_transmitted() {
  if (transmit_errors_ > 0) {
    --transmit_errors_;
    update_state();
  }
}

void SimulatedCanBus::take(const CanFrame& frame) {
  if (!up_ || state_ == CanState::bus_off) {
    return;
  }
  const auto filters = std::span(filters_).first(filter_count_);
  if (std::ranges::any_of(filters,
                          [&](const CanFilter& filter) { return passes(filter, frame); })) {
    CanReceived item;
    item.frame = frame;
    item.time_ns = network_.clock().now_ns();
    enqueue(item);
  }
}

void SimulatedCanBus::enqueue(const CanReceived& item) {
  if (receive_queue_.size() >= config_.receive_capacity) {
    ++receive_dropped_;
    return;
  }
  receive_queue_.push(item);
}

void SimulatedCanBus::update_state() {
  if (transmit_errors_ >= kBusOffThreshold) {
    enter(CanState::bus_off, 0);
  } else if (transmit_errors_ >= kPassiveThreshold) {
    enter(CanState::error_passive, kCanTransmitPassive);
  } else if (transmit_errors_ >= kWarningThreshold) {
    enter(CanState::error_warning, kCanTransmitWarning);
  } else {
    enter(CanState::error_active, kCanBackToActive);
  }
}

void SimulatedCanBus::enter(CanState state, std::uint8_t controller) {
  if (state == state_) {
    return;
  }
  state_ = state;
  if (state == CanState::bus_off) {
    send_queue_.clear();
    network_.abandon(*this);
    inject_error({.classes = kCanBusOff});
  } else {
    inject_error({.classes = kCanController | kCanErrorCounters,
                  .controller = controller,
                  .transmit_errors = saturated(transmit_errors_)});
  }
}

}  // namespace tactus::hal
