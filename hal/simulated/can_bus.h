// A CAN node in memory, for tests and emulated drives. One thread; see simulated/clock.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/can_bus.h"
#include "hal/simulated/can_network.h"
#include "hal/simulated/fixed_queue.h"

namespace tactus::hal {

// The abilities of a node and the sizes of its queues.
struct SimulatedCanBusConfig {
  // The node may send CAN FD on a network that carries it.
  bool fd = true;
  // The size of the send queue in frames, at most SimulatedCanBus::kMaxSendQueue.
  std::size_t send_capacity = 32;
  // The size of the receive queue in frames, at most SimulatedCanBus::kMaxReceiveQueue.
  std::size_t receive_capacity = 256;
};

// A node on a SimulatedCanNetwork.
//
// Simulated: bounded queues in both directions (a full receive queue drops and counts), kernel
// filters, error reports, error counters and their states, bus-off and restart, a link that goes
// down, a removed interface. Not simulated: receive errors; missing acknowledgement (a single
// node's frames count as sent); the kernel's loss of frames while the controller is off the bus
// (here `send` returns bus_off).
class SimulatedCanBus final : public CanBus {
 public:
  // The largest sizes of the two queues, in frames.
  static constexpr std::size_t kMaxSendQueue = 64;
  static constexpr std::size_t kMaxReceiveQueue = 512;

  // Attaches the node to the network, which must outlive it. Larger queues than possible are cut.
  explicit SimulatedCanBus(SimulatedCanNetwork& network, const SimulatedCanBusConfig& config = {});
  SimulatedCanBus(const SimulatedCanBus&) = delete;
  SimulatedCanBus& operator=(const SimulatedCanBus&) = delete;
  ~SimulatedCanBus();

  // The following functions cause faults. A link that is down keeps the received frames, loses the
  // frames to send, and receives nothing. A link that comes up is error_active again.
  void set_link_up(bool up);
  // Removes the interface for good. Calls return `disconnected`; `receive` first returns the frames
  // that have arrived.
  void remove_interface();
  // Takes the controller off the bus, as 32 failed transmissions do.
  void force_bus_off();
  // Queues the report as if it came from the controller, if its class is enabled and the link is
  // up.
  void inject_error(const CanErrorReport& report);
  // Makes the next `count` transmissions fail. Each adds 8 to the transmit counter and is repeated
  // until one succeeds.
  void fail_transmissions(std::uint32_t count);

  // Return the numbers of frames in the send queue and of items in the receive queue.
  std::size_t waiting_to_send() const { return send_queue_.size(); }
  std::size_t waiting_to_be_read() const { return receive_queue_.size(); }

 private:
  friend class SimulatedCanNetwork;

  // The choice of frames and error reports that the node receives, and the count of the lost ones.
  struct Reception {
    // At first one filter that lets everything pass.
    std::array<CanFilter, kMaxCanFilters> filters{};
    std::size_t filter_count = 1;
    std::uint32_t error_classes = 0;
    // The items that found the receive queue full.
    std::uint64_t dropped = 0;
  };
  // The fault confinement of ISO 11898-1.
  struct FaultConfinement {
    CanState state = CanState::error_active;
    // The transmit error counter; at 256 the controller is off the bus.
    std::uint32_t transmit_errors = 0;
  };
  // The interface as the kernel has it.
  struct Interface {
    bool is_up = true;
    bool is_present = true;
  };

  Result<std::size_t> DoSend(std::span<const CanFrame> frames) override;
  Result<std::size_t> DoReceive(std::span<CanReceived> received, TimeNs deadline_ns) override;
  Result<void> DoSetFilters(std::span<const CanFilter> filters) override;
  Result<void> DoSetErrorClasses(std::uint32_t classes) override;
  Result<void> DoRestart() override;
  CanStatus DoStatus() const override;
  std::uint64_t DoReceiveDropped() const override { return reception_.dropped; }
  bool DoFdEnabled() const override { return config_.fd && network_.config().fd; }

  // The network calls these four. may_send: the node has a frame and may use the wire.
  bool may_send() const {
    return !send_queue_.empty() && confinement_.state != CanState::bus_off && interface_.is_up;
  }
  // Returns true if the frame on the wire is to fail, and counts the error.
  bool transmission_fails();
  // Counts a good transmission.
  void note_transmitted();
  // Receives another node's frame, if a filter lets it pass.
  void take(const CanFrame& frame);

  // Appends to the receive queue, or counts a dropped item if it is full.
  void enqueue(const CanReceived& item);
  // Changes the state and reports the change; `controller` holds CanControllerProblem bits.
  void enter(CanState state, std::uint8_t controller);
  // Enters the state of the present transmit counter.
  void update_state();

  SimulatedCanNetwork& network_;
  SimulatedCanBusConfig config_;
  // The next node in the network's list.
  SimulatedCanBus* next_ = nullptr;
  FixedQueue<CanFrame, kMaxSendQueue> send_queue_;
  FixedQueue<CanReceived, kMaxReceiveQueue> receive_queue_;
  Reception reception_;
  FaultConfinement confinement_;
  Interface interface_;
  // The number of transmissions still to fail.
  std::uint32_t failing_ = 0;
};

}  // namespace tactus::hal
