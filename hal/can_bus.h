// One node on a CAN bus: what a board offers to reach motor drives over CAN and CAN FD.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/can_frame.h"
#include "hal/clock.h"
#include "hal/error.h"

namespace tactus::hal {

inline constexpr std::size_t kMaxCanFilters = 64;

enum class CanState : std::uint8_t {
  error_active,   // well: both error counters below 96
  error_warning,  // a counter at 96 or more
  error_passive,  // a counter at 128 or more
  bus_off,        // the transmit counter passed 255: silent and deaf until `restart`
  stopped,        // the interface is down
};

struct CanStatus {
  CanState state = CanState::error_active;
  std::uint8_t transmit_errors = 0;  // 255 stands for more
  std::uint8_t receive_errors = 0;
};

// Since opening; only ever grows.
struct CanCounters {
  std::uint64_t sent = 0;             // frames the send queue took
  std::uint64_t send_refused = 0;     // frames it did not take for want of room
  std::uint64_t received = 0;         // frames handed out by `receive`
  std::uint64_t error_reports = 0;    // error reports handed out by `receive`
  std::uint64_t receive_dropped = 0;  // frames and reports lost because the receive queue was full
};

// Real time: send, receive, status and counters, after opening; they allocate nothing. Filters and
// restart are not. Thread: one at a time for each object; not from an interrupt. Opening is the
// implementation's own affair.
class CanBus {
 public:
  CanBus(const CanBus&) = delete;
  CanBus& operator=(const CanBus&) = delete;

  // Puts frames into the send queue, in order, and returns how many found room; never waits. Being
  // taken does not mean being on the wire. No frame is taken if any is malformed.
  //   queue_full        not even the first found room; count it and go on
  //   link_down         the interface is down
  //   bus_off           the controller is off the bus
  //   disconnected      the interface is gone
  //   not_supported     a CAN FD frame on a classic bus
  //   invalid_argument  !is_valid(frame)
  //   io                anything else the system reports
  Result<std::size_t> send(std::span<const CanFrame> frames);
  Result<void> send(const CanFrame& frame);

  // Waits until something has arrived or the deadline has passed, then hands out what there is,
  // oldest first, and returns how many (at least 1). What arrived before the link went down is
  // handed out before link_down is.
  //   timeout           nothing arrived
  //   link_down         the interface is down
  //   disconnected      the interface is gone
  //   invalid_argument  `received` is empty
  //   io                anything else the system reports
  // Off the bus it is a timeout: the bus-off report, if subscribed to, is in the queue.
  Result<std::size_t> receive(std::span<CanReceived> received, TimeNs deadline_ns);

  // From now on a frame is queued if it passes any of these; with none, no frame is. As opened,
  // every frame is. What is already queued stays. Error reports take no part in this.
  //   invalid_argument  more than kMaxCanFilters
  //   disconnected, io
  Result<void> set_filters(std::span<const CanFilter> filters);

  // Which error reports (CanErrorClass bits) are queued from now on. As opened, none.
  //   disconnected, io
  Result<void> set_error_classes(std::uint32_t classes);

  // Goes back on the bus. Frames that waited to be sent at bus-off are lost.
  //   invalid_state  the controller is not off the bus
  //   link_down      the interface is down
  //   not_permitted  on Linux this takes CAP_NET_ADMIN
  //   not_supported  no real controller (vcan), or the controller restarts by itself
  //   disconnected, io
  Result<void> restart();

  // As far as known, without a system call.
  CanStatus status() const { return DoStatus(); }
  CanCounters counters() const;

  // Whether the bus carries CAN FD.
  bool fd_enabled() const { return DoFdEnabled(); }

 protected:
  CanBus() = default;
  ~CanBus() = default;

 private:
  // The arguments have been checked; `frames` and `received` are not empty.
  virtual Result<std::size_t> DoSend(std::span<const CanFrame> frames) = 0;
  virtual Result<std::size_t> DoReceive(std::span<CanReceived> received, TimeNs deadline_ns) = 0;
  virtual Result<void> DoSetFilters(std::span<const CanFilter> filters) = 0;
  virtual Result<void> DoSetErrorClasses(std::uint32_t classes) = 0;
  virtual Result<void> DoRestart() = 0;
  virtual CanStatus DoStatus() const = 0;
  virtual std::uint64_t DoReceiveDropped() const = 0;
  virtual bool DoFdEnabled() const = 0;

  CanCounters counters_;
};

}  // namespace tactus::hal
