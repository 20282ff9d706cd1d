// The wire that connects simulated CAN nodes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/can_frame.h"
#include "hal/simulated/clock.h"

namespace tactus::hal {

class SimulatedCanBus;

struct SimulatedCanNetworkConfig {
  bool fd = false;
  std::uint32_t bit_rate = 0;  // bit/s; 0: a frame takes no time
  // bit/s of the data phase of a bit-rate-switched frame; 0: the same as bit_rate
  std::uint32_t data_bit_rate = 0;
};

// Returns how long a frame occupies the wire, ns, without stuff bits (which add up to a fifth).
TimeNs wire_time_ns(const CanFrame& frame, const SimulatedCanNetworkConfig& config);

// Simulated: arbitration (when the wire becomes idle, the node whose oldest frame has the lowest
// identifier sends it), the duration of a frame, delivery to every other node that is up, and loss.
// Not simulated: stuff bits, error frames on the wire, reception of a node's own frames, two nodes
// that send the same identifier at once (the first attached wins), different bit rates on one wire.
class SimulatedCanNetwork final : private SimulatedEventSource {
 public:
  explicit SimulatedCanNetwork(SimulatedClock& clock, const SimulatedCanNetworkConfig& config = {});
  SimulatedCanNetwork(const SimulatedCanNetwork&) = delete;
  SimulatedCanNetwork& operator=(const SimulatedCanNetwork&) = delete;
  ~SimulatedCanNetwork();

  SimulatedClock& clock() { return clock_; }
  const SimulatedCanNetworkConfig& config() const { return config_; }

  // Loses the next `count` frames; their senders do not notice.
  void lose_next(std::uint32_t count) { losing_ = count; }
  std::uint64_t lost() const { return lost_; }
  std::uint64_t delivered() const { return delivered_; }  // frames that crossed the wire

 private:
  friend class SimulatedCanBus;
  void attach(SimulatedCanBus& bus);
  void detach(SimulatedCanBus& bus);
  void serve();  // puts as many waiting frames on the wire as it can carry now
  void abandon(const SimulatedCanBus& bus);  // removes the node's unfinished frame from the wire

  TimeNs next_event_ns() const override { return sender_ == nullptr ? kForever : wire_free_ns_; }
  void run_event() override;
  SimulatedCanBus* arbitrate();
  void deliver();

  SimulatedClock& clock_;
  SimulatedCanNetworkConfig config_;
  SimulatedCanBus* first_ = nullptr;
  SimulatedCanBus* sender_ = nullptr;  // node whose frame is on the wire; null: idle
  TimeNs wire_free_ns_ = 0;
  std::uint32_t losing_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t delivered_ = 0;
};

}  // namespace tactus::hal
