// What a raw CAN socket takes and gives: frames, error frames, and what comes beside them.
#pragma once

#include <linux/can.h>
#include <sys/socket.h>

#include <cstddef>
#include <cstdint>

#include "hal/can_bus.h"
#include "hal/clock.h"

namespace tactus::hal {

// The same bytes serve both kinds: a classic frame is the beginning of an FD frame.
struct CanWireFrame {
  canfd_frame frame{};
  std::size_t bytes = 0;
};

CanWireFrame to_wire(const CanFrame& frame);
CanFrame from_wire(const canfd_frame& wire, bool fd);

// Of a frame with CAN_ERR_FLAG.
CanErrorReport error_from_wire(const canfd_frame& wire);

// What the kernel says beside a frame.
struct CanAncillary {
  TimeNs realtime_ns = 0;   // of its arrival, CLOCK_REALTIME; 0: not stamped
  std::uint32_t drops = 0;  // that the socket has had so far
  bool tells_drops = false;
};
CanAncillary read_ancillary(msghdr& message);

}  // namespace tactus::hal
