// One node on a CAN bus: the interface through which the motor drives on CAN and CAN FD are
// reached.
//
// A driver takes a reference to CanBus. SocketCAN (hal/linux/can_bus.h) and the bus in memory
// (hal/simulated/can_bus.h) implement it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/can_frame.h"
#include "hal/clock.h"
#include "hal/error.h"

namespace tactus::hal {

// The largest number of filters that set_filters takes.
inline constexpr std::size_t kMaxCanFilters = 64;

// The state of the node's controller, by its error counters (ISO 11898-1, fault confinement).
enum class CanState : std::uint8_t {
  // Normal: both error counters are below 96.
  error_active,
  // One of the counters is 96 or more.
  error_warning,
  // One of the counters is 128 or more: the node may no longer disturb the frames of others.
  error_passive,
  // The transmit counter passed 255: the node neither sends nor receives until `restart`.
  bus_off,
  // The network interface is down, or gone.
  stopped,
};

// The controller's state and its error counters, as last reported.
struct CanStatus {
  CanState state = CanState::error_active;
  // Each failed transmission adds 8 and each good one subtracts 1. 255 stands for 255 or more.
  std::uint8_t transmit_errors = 0;
  // The same for received frames; 255 stands for 255 or more.
  std::uint8_t receive_errors = 0;
};

// Numbers counted since opening.
struct CanCounters {
  std::uint64_t sent = 0;             // frames that the send queue took
  std::uint64_t send_refused = 0;     // frames refused because the send queue was full
  std::uint64_t received = 0;         // frames returned by `receive`
  std::uint64_t error_reports = 0;    // error reports returned by `receive`
  std::uint64_t receive_dropped = 0;  // frames and reports lost because the receive queue was full
};

// A node that sends and receives frames through two bounded queues.
//
// Real time: send, receive, status and counters are real time after opening and allocate nothing;
// set_filters, set_error_classes and restart are not. Thread: one at a time for each object; not
// from an interrupt. Opening is not part of the interface: each implementation has its own
// function.
class CanBus {
 public:
  CanBus(const CanBus&) = delete;
  CanBus& operator=(const CanBus&) = delete;

  // Puts frames into the send queue in order and returns how many it took; never waits. A frame in
  // the queue is not on the wire yet. If any frame is malformed, none is taken.
  //   queue_full        there was no room for the first frame; count it and go on
  //   link_down         the interface is down
  //   bus_off           the controller is off the bus
  //   disconnected      the interface is gone
  //   not_supported     a CAN FD frame on a classic bus
  //   invalid_argument  !is_valid(frame)
  //   io                anything else the system reports
  Result<std::size_t> send(std::span<const CanFrame> frames);
  // Puts one frame into the send queue. The errors are those above.
  Result<void> send(const CanFrame& frame);

  // Waits until something has arrived or the deadline has passed. Then returns the number of items
  // put into `received`, at least 1, oldest first. Items that arrived before the link went down are
  // returned before link_down is.
  //   timeout           nothing arrived
  //   link_down         the interface is down
  //   disconnected      the interface is gone
  //   invalid_argument  `received` is empty
  //   io                anything else the system reports
  // Off the bus it returns timeout; the queue contains the bus-off report if that was enabled.
  Result<std::size_t> receive(std::span<CanReceived> received, TimeNs deadline_ns);

  // Sets the receive filters: from now on a frame is queued if it passes any of them. With no
  // filter no frame is queued. After opening, every frame is. Queued frames stay, and error reports
  // are not filtered.
  //   invalid_argument  more than kMaxCanFilters
  //   disconnected, io
  Result<void> set_filters(std::span<const CanFilter> filters);

  // Sets the error reports (CanErrorClass bits) that are queued from now on. After opening, none
  // is.
  //   disconnected, io
  Result<void> set_error_classes(std::uint32_t classes);

  // Brings the controller back on the bus. Frames that waited for sending at bus-off are lost.
  //   invalid_state  the controller is not off the bus
  //   link_down      the interface is down
  //   not_permitted  on Linux this takes CAP_NET_ADMIN
  //   not_supported  no real controller (vcan), or the controller restarts by itself
  //   disconnected, io
  Result<void> restart();

  // Returns the last known status, without a system call.
  CanStatus status() const { return DoStatus(); }
  // Returns the numbers of frames sent, received and lost since opening, without a system call.
  CanCounters counters() const;

  // Returns true if the bus carries CAN FD.
  bool fd_enabled() const { return DoFdEnabled(); }

 protected:
  CanBus() = default;
  ~CanBus() = default;

  // Sets the counters to 0, except receive_dropped. An implementation calls it at each opening.
  void clear_counters() { counters_ = {}; }

 private:
  // The public functions have checked the arguments; `frames` and `received` are not empty.
  virtual Result<std::size_t> DoSend(std::span<const CanFrame> frames) = 0;
  virtual Result<std::size_t> DoReceive(std::span<CanReceived> received, TimeNs deadline_ns) = 0;
  virtual Result<void> DoSetFilters(std::span<const CanFilter> filters) = 0;
  virtual Result<void> DoSetErrorClasses(std::uint32_t classes) = 0;
  virtual Result<void> DoRestart() = 0;
  virtual CanStatus DoStatus() const = 0;
  virtual std::uint64_t DoReceiveDropped() const = 0;
  virtual bool DoFdEnabled() const = 0;

  // All but receive_dropped, which the implementation counts.
  CanCounters counters_;
};

}  // namespace tactus::hal
