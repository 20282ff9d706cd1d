#include "hal/simulated/can_network.h"

#include "hal/simulated/can_bus.h"

namespace tactus::hal {

namespace {

constexpr TimeNs kNsPerSecond = 1'000'000'000;

// The numbers of bits outside and inside the data phase of an ISO 11898-1 frame, from the start of
// frame to the end of the interframe space.
struct BitCount {
  TimeNs nominal = 0;
  TimeNs data = 0;
};

BitCount count_bits(const CanFrame& frame) {
  const auto payload = static_cast<TimeNs>(8 * frame.bytes().size());
  if (!frame.fd) {
    // A classic frame without data has 44 bits, an extended one 64; the interframe space adds 3.
    return {.nominal = (frame.extended ? 67 : 47) + payload, .data = 0};
  }
  // The CRC has 17 bits up to 16 bytes of data and 21 bits above. The stuff count, with its parity,
  // precedes it. A fixed stuff bit begins the field of both and follows after every fourth bit of
  // it: 6 or 7 in all (ISO 11898-1:2015).
  const TimeNs stuff_count = 4;
  const TimeNs checksum = frame.length <= 16 ? 17 + 6 : 21 + 7;  // with the fixed stuff bits
  return {.nominal = (frame.extended ? 36 : 17) + 13,
          .data = 1 + 4 + payload + stuff_count + checksum};
}

// Returns the bits that decide arbitration, most significant first. At equal base identifiers a
// standard frame wins over an extended one, and data over a remote request.
std::uint64_t arbitration_key(const CanFrame& frame) {
  const std::uint64_t base = frame.extended ? frame.id >> 18U : frame.id;
  const std::uint64_t rest = frame.extended ? frame.id & 0x3FFFFU : 0U;
  return (base << 20U) | (std::uint64_t{frame.extended} << 19U) | (rest << 1U) |
         std::uint64_t{frame.remote};
}

}  // namespace

TimeNs wire_time_ns(const CanFrame& frame, const SimulatedCanNetworkConfig& config) {
  if (config.bit_rate == 0) {
    return 0;
  }
  const bool fast = frame.bit_rate_switch && config.data_bit_rate != 0;
  const TimeNs data_rate = fast ? config.data_bit_rate : config.bit_rate;
  const BitCount bits = count_bits(frame);
  return bits.nominal * kNsPerSecond / config.bit_rate + bits.data * kNsPerSecond / data_rate;
}

SimulatedCanNetwork::SimulatedCanNetwork(SimulatedClock& clock,
                                         const SimulatedCanNetworkConfig& config)
    : clock_(clock), config_(config) {
  clock_.attach(*this);
}

SimulatedCanNetwork::~SimulatedCanNetwork() {
  clock_.detach(*this);
}

void SimulatedCanNetwork::attach(SimulatedCanBus& bus) {
  SimulatedCanBus** link = &first_;
  while (*link != nullptr) {
    link = &(*link)->next_;
  }
  *link = &bus;
}

void SimulatedCanNetwork::detach(SimulatedCanBus& bus) {
  for (SimulatedCanBus** link = &first_; *link != nullptr; link = &(*link)->next_) {
    if (*link == &bus) {
      *link = bus.next_;
      break;
    }
  }
  abandon(bus);
}

void SimulatedCanNetwork::abandon(const SimulatedCanBus& bus) {
  if (sender_ == &bus) {
    sender_ = nullptr;
    serve();
  }
}

void SimulatedCanNetwork::serve() {
  while (sender_ == nullptr) {
    sender_ = arbitrate();
    if (sender_ == nullptr) {
      return;
    }
    const TimeNs duration_ns = wire_time_ns(sender_->send_queue_.front(), config_);
    wire_free_ns_ = clock_.now_ns() + duration_ns;
    if (duration_ns == 0) {
      deliver();
    }
  }
}

void SimulatedCanNetwork::run_event() {
  deliver();
  serve();
}

SimulatedCanBus* SimulatedCanNetwork::arbitrate() {
  SimulatedCanBus* winner = nullptr;
  for (SimulatedCanBus* bus = first_; bus != nullptr; bus = bus->next_) {
    if (bus->may_send() &&
        (winner == nullptr || arbitration_key(bus->send_queue_.front()) <
                                  arbitration_key(winner->send_queue_.front()))) {
      winner = bus;
    }
  }
  return winner;
}

// Ends the frame on the wire: removes it from the sender's queue and gives it to all other nodes.
void SimulatedCanNetwork::deliver() {
  SimulatedCanBus& sender = *sender_;
  sender_ = nullptr;
  if (sender.transmission_fails()) {
    return;
  }
  const CanFrame frame = sender.send_queue_.front();
  sender.send_queue_.pop();
  sender.note_transmitted();
  if (losing_ > 0) {
    --losing_;
    ++lost_;
    return;
  }
  ++delivered_;
  for (SimulatedCanBus* bus = first_; bus != nullptr; bus = bus->next_) {
    if (bus != &sender) {
      bus->take(frame);
    }
  }
}

}  // namespace tactus::hal
