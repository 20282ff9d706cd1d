// A CAN node in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/can_bus.h"
#include "hal/simulated/can_network.h"
#include "hal/simulated/fixed_queue.h"

namespace tactus::hal {

struct SimulatedCanBusConfig {
  bool fd = true;                      // the node may send CAN FD on a network that carries it
  std::size_t send_capacity = 32;      // frames; at most SimulatedCanBus::kMaxSendQueue
  std::size_t receive_capacity = 256;  // frames; at most SimulatedCanBus::kMaxReceiveQueue
};

// Simulated: bounded queues in both directions (a full receive queue drops and counts), kernel
// filters, error reports, error counters and their states, bus-off and restart, a link that goes
// down, a removed interface.
// Not simulated: receive errors; missing acknowledgement (a single node's frames count as sent);
// the kernel's loss of frames while the controller is off the bus (here `send` returns bus_off).
class SimulatedCanBus final : public CanBus {
 public:
  static constexpr std::size_t kMaxSendQueue = 64;
  static constexpr std::size_t kMaxReceiveQueue = 512;

  explicit SimulatedCanBus(SimulatedCanNetwork& network, const SimulatedCanBusConfig& config = {});
  SimulatedCanBus(const SimulatedCanBus&) = delete;
  SimulatedCanBus& operator=(const SimulatedCanBus&) = delete;
  ~SimulatedCanBus();

  // These cause faults. A link that is down keeps the received frames, loses the frames to send,
  // and receives nothing.
  void set_link_up(bool up);
  void remove_interface();
  void force_bus_off();
  void inject_error(const CanErrorReport& report);  // like a report from the controller
  // Makes the next `count` transmissions fail. Each adds 8 to the transmit counter and is repeated.
  void fail_transmissions(std::uint32_t count);

  std::size_t waiting_to_send() const { return send_queue_.size(); }
  std::size_t waiting_to_be_read() const { return receive_queue_.size(); }

 private:
  friend class SimulatedCanNetwork;

  Result<std::size_t> DoSend(std::span<const CanFrame> frames) override;
  Result<std::size_t> DoReceive(std::span<CanReceived> received, TimeNs deadline_ns) override;
  Result<void> DoSetFilters(std::span<const CanFilter> filters) override;
  Result<void> DoSetErrorClasses(std::uint32_t classes) override;
  Result<void> DoRestart() override;
  CanStatus DoStatus() const override;
  std::uint64_t DoReceiveDropped() const override { return receive_dropped_; }
  bool DoFdEnabled() const override { return config_.fd && network_.config().fd; }

  // The network calls these.
  bool may_send() const { return !send_queue_.empty() && state_ != CanState::bus_off && up_; }
  bool transmission_fails();
  void note_transmitted();
  void take(const CanFrame& frame);

  void enqueue(const CanReceived& item);
  void enter(CanState state, std::uint8_t controller);
  void update_state();

  SimulatedCanNetwork& network_;
  SimulatedCanBusConfig config_;
  SimulatedCanBus* next_ = nullptr;
  FixedQueue<CanFrame, kMaxSendQueue> send_queue_;
  FixedQueue<CanReceived, kMaxReceiveQueue> receive_queue_;
  std::array<CanFilter, kMaxCanFilters> filters_{};
  std::size_t filter_count_ = 1;  // at first one filter that lets everything pass
  std::uint32_t error_classes_ = 0;
  CanState state_ = CanState::error_active;
  std::uint32_t transmit_errors_ = 0;
  std::uint32_t failing_ = 0;
  std::uint64_t receive_dropped_ = 0;
  bool up_ = true;
  bool present_ = true;
};

}  // namespace tactus::hal
