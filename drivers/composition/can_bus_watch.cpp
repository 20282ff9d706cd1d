#include "drivers/composition/can_bus_watch.h"

namespace tactus::drivers {

void CanBusWatch::note(const hal::Result<void>& outcome) {
  if (!outcome) {
    lose(outcome.error());
  }
}

void CanBusWatch::note_sent(const hal::Result<std::size_t>& sent, std::size_t offered) {
  if (sent && *sent == offered) {
    full_in_a_row_ = 0;
    return;
  }
  if (!sent && sent.error().code != hal::ErrorCode::queue_full) {
    lose(sent.error());
    return;
  }
  ++full_in_a_row_;
  if (full_in_a_row_ >= kFullQueuesToLoss) {
    lose({hal::ErrorCode::queue_full, 0});
  }
}

void CanBusWatch::note_received(const hal::Error& error) {
  if (error.code != hal::ErrorCode::timeout) {
    lose(error);
  }
}

void CanBusWatch::take(const hal::CanReceived& received) {
  if (received.kind == hal::CanReceived::Kind::error &&
      (received.error.classes & hal::kCanBusOff) != 0) {
    lose({hal::ErrorCode::bus_off, 0});
  }
}

void CanBusWatch::lose(const hal::Error& error) {
  off_the_bus_ = off_the_bus_ || error.code == hal::ErrorCode::bus_off;
  if (trouble_) {
    return;
  }
  const auto code = static_cast<std::uint32_t>(error.errno_value);
  switch (error.code) {
    case hal::ErrorCode::link_down:
      trouble_ = {"the CAN interface is down", "bring it up (ip link set IF up), then reset", code};
      return;
    case hal::ErrorCode::bus_off:
      trouble_ = {"the CAN controller went off the bus after too many errors",
                  "check wiring, termination and bit rate, then reset", code};
      return;
    case hal::ErrorCode::queue_full:
      trouble_ = {"the CAN send queue stays full: no drive acknowledges, or the bus is overloaded",
                  "check power and wiring of the drives and the bit rate, then reset", code};
      return;
    case hal::ErrorCode::disconnected:
      trouble_ = {"the CAN interface is gone", "plug the adapter in again and restart", code};
      return;
    default:
      trouble_ = {"the CAN interface fails", "see the error number; restart the interface", code};
      return;
  }
}

}  // namespace tactus::drivers
