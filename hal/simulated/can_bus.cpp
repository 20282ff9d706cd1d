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
  if (!interface_.is_present) {
    return failure(ErrorCode::disconnected);
  }
  if (!interface_.is_up) {
    return failure(ErrorCode::link_down);
  }
  if (confinement_.state == CanState::bus_off) {
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
  network_.clock().wait_until(deadline_ns, [this] {
    return !receive_queue_.empty() || !interface_.is_up || !interface_.is_present;
  });
  std::size_t count = 0;
  while (count < received.size() && !receive_queue_.empty()) {
    received[count] = receive_queue_.front();
    receive_queue_.pop();
    ++count;
  }
  if (count > 0) {
    return count;
  }
  if (!interface_.is_present) {
    return failure(ErrorCode::disconnected);
  }
  return failure(interface_.is_up ? ErrorCode::timeout : ErrorCode::link_down);
}

Result<void> SimulatedCanBus::DoSetFilters(std::span<const CanFilter> filters) {
  if (!interface_.is_present) {
    return failure(ErrorCode::disconnected);
  }
  std::ranges::copy(filters, reception_.filters.begin());
  reception_.filter_count = filters.size();
  return {};
}

Result<void> SimulatedCanBus::DoSetErrorClasses(std::uint32_t classes) {
  if (!interface_.is_present) {
    return failure(ErrorCode::disconnected);
  }
  reception_.error_classes = classes;
  return {};
}

Result<void> SimulatedCanBus::DoRestart() {
  if (!interface_.is_present) {
    return failure(ErrorCode::disconnected);
  }
  if (!interface_.is_up) {
    return failure(ErrorCode::link_down);
  }
  if (confinement_.state != CanState::bus_off) {
    return failure(ErrorCode::invalid_state);
  }
  confinement_.transmit_errors = 0;
  confinement_.state = CanState::error_active;
  inject_error({.classes = kCanRestarted});
  return {};
}

CanStatus SimulatedCanBus::DoStatus() const {
  return {
      .state = interface_.is_up && interface_.is_present ? confinement_.state : CanState::stopped,
      .transmit_errors = saturated(confinement_.transmit_errors),
      .receive_errors = 0};
}

void SimulatedCanBus::set_link_up(bool up) {
  interface_.is_up = up;
  if (up) {
    confinement_.transmit_errors = 0;
    confinement_.state = CanState::error_active;
  } else {
    send_queue_.clear();
    network_.abandon(*this);
  }
}

void SimulatedCanBus::remove_interface() {
  set_link_up(false);
  interface_.is_present = false;
}

void SimulatedCanBus::force_bus_off() {
  confinement_.transmit_errors = kBusOffThreshold;
  update_state();
}

void SimulatedCanBus::inject_error(const CanErrorReport& report) {
  if ((report.classes & reception_.error_classes) != 0 && interface_.is_up) {
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
  confinement_.transmit_errors += kCostOfAFailure;
  inject_error({.classes = kCanProtocol | kCanBusError | kCanErrorCounters,
                .transmit_errors = saturated(confinement_.transmit_errors)});
  update_state();
  return true;
}

void SimulatedCanBus::note_transmitted() {
  if (confinement_.transmit_errors > 0) {
    --confinement_.transmit_errors;
    update_state();
  }
}

void SimulatedCanBus::take(const CanFrame& frame) {
  if (!interface_.is_up || confinement_.state == CanState::bus_off) {
    return;
  }
  const auto filters = std::span(reception_.filters).first(reception_.filter_count);
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
    ++reception_.dropped;
    return;
  }
  receive_queue_.push(item);
}

void SimulatedCanBus::update_state() {
  if (confinement_.transmit_errors >= kBusOffThreshold) {
    enter(CanState::bus_off, 0);
  } else if (confinement_.transmit_errors >= kPassiveThreshold) {
    enter(CanState::error_passive, kCanTransmitPassive);
  } else if (confinement_.transmit_errors >= kWarningThreshold) {
    enter(CanState::error_warning, kCanTransmitWarning);
  } else {
    enter(CanState::error_active, kCanBackToActive);
  }
}

void SimulatedCanBus::enter(CanState state, std::uint8_t controller) {
  if (state == confinement_.state) {
    return;
  }
  confinement_.state = state;
  if (state == CanState::bus_off) {
    send_queue_.clear();
    network_.abandon(*this);
    inject_error({.classes = kCanBusOff});
  } else {
    inject_error({.classes = kCanController | kCanErrorCounters,
                  .controller = controller,
                  .transmit_errors = saturated(confinement_.transmit_errors)});
  }
}

}  // namespace tactus::hal
