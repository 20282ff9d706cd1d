// The wire that connects simulated CAN nodes. One thread; see simulated/clock.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/can_frame.h"
#include "hal/simulated/clock.h"

namespace tactus::hal {

class SimulatedCanBus;

// The kind of bus and its speed.
struct SimulatedCanNetworkConfig {
  // True if the wire carries CAN FD frames.
  bool fd = false;
  // The bit rate in bit/s; 0: a frame takes no time.
  std::uint32_t bit_rate = 0;
  // The bit rate of the data phase of a bit-rate-switched frame, bit/s; 0: the same as bit_rate.
  std::uint32_t data_bit_rate = 0;
};

// Returns how long a frame occupies the wire, ns, without stuff bits (which add up to a fifth).
TimeNs wire_time_ns(const CanFrame& frame, const SimulatedCanNetworkConfig& config);

// The wire that the nodes share.
//
// Simulated: arbitration (when the wire becomes idle, the node whose oldest frame has the lowest
// identifier sends it), the duration of a frame, delivery to every other node that is up, and loss.
// Not simulated: stuff bits, error frames on the wire, reception of a node's own frames, two nodes
// that send the same identifier at once (the first attached wins), different bit rates on one wire.
class SimulatedCanNetwork final : private SimulatedEventSource {
 public:
  // Attaches the wire to the clock, which must outlive it, as it must outlive its nodes.
  explicit SimulatedCanNetwork(SimulatedClock& clock, const SimulatedCanNetworkConfig& config = {});
  SimulatedCanNetwork(const SimulatedCanNetwork&) = delete;
  SimulatedCanNetwork& operator=(const SimulatedCanNetwork&) = delete;
  ~SimulatedCanNetwork();

  // Returns the clock and the settings of the wire.
  SimulatedClock& clock() { return clock_; }
  const SimulatedCanNetworkConfig& config() const { return config_; }

  // Loses the next `count` frames; their senders do not notice.
  void lose_next(std::uint32_t count) { losing_ = count; }
  // Returns the number of frames lost by lose_next().
  std::uint64_t lost() const { return lost_; }
  // Returns the number of frames that crossed the wire and were given to the other nodes.
  std::uint64_t delivered() const { return delivered_; }

 private:
  friend class SimulatedCanBus;
  void attach(SimulatedCanBus& bus);
  void detach(SimulatedCanBus& bus);
  // Puts as many waiting frames on the wire as it can carry now.
  void serve();
  // Removes the node's unfinished frame from the wire.
  void abandon(const SimulatedCanBus& bus);

  TimeNs next_event_ns() const override { return sender_ == nullptr ? kForever : wire_free_ns_; }
  void run_event() override;
  // Returns the node whose oldest frame wins the idle wire; null if no node wants to send.
  SimulatedCanBus* arbitrate();
  // Ends the frame on the wire: it fails, is lost, or goes to all other nodes.
  void deliver();

  SimulatedClock& clock_;
  SimulatedCanNetworkConfig config_;
  // The list of nodes, in the order of attachment.
  SimulatedCanBus* first_ = nullptr;
  // The node whose frame is on the wire; null: idle.
  SimulatedCanBus* sender_ = nullptr;
  // The time at which the frame on the wire ends.
  TimeNs wire_free_ns_ = 0;
  // The number of frames still to lose.
  std::uint32_t losing_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t delivered_ = 0;
};

}  // namespace tactus::hal
