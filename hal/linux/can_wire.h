// Converts between CanFrame and the structures of a raw CAN socket: frames, error frames and
// ancillary data.
#pragma once

#include <linux/can.h>
#include <sys/socket.h>

#include <cstddef>
#include <cstdint>

#include "hal/can_bus.h"
#include "hal/clock.h"

namespace tactus::hal {

// A frame as the socket takes it. A classic frame has the layout of the beginning of an FD frame.
struct CanWireFrame {
  canfd_frame frame{};
  std::size_t bytes = 0;
};

CanWireFrame to_wire(const CanFrame& frame);
CanFrame from_wire(const canfd_frame& wire, bool fd);

// Converts a frame with CAN_ERR_FLAG.
CanErrorReport error_from_wire(const canfd_frame& wire);

// The ancillary data of a received frame.
struct CanAncillary {
  TimeNs realtime_ns = 0;    // time of arrival, CLOCK_REALTIME; 0: no time stamp
  std::uint32_t drops = 0;   // frames that the socket has dropped so far
  bool tells_drops = false;  // true if `drops` is valid
};
CanAncillary read_ancillary(msghdr& message);

}  // namespace tactus::hal
