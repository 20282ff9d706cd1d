// Converts between CanFrame and the structures of a raw CAN socket: frames, error frames and
// ancillary data. All are pure functions, for any thread; real time.
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
  // The number of bytes that the socket shall take: CAN_MTU or CANFD_MTU.
  std::size_t bytes = 0;
};

// Returns a valid frame in the form of the socket.
CanWireFrame to_wire(const CanFrame& frame);
// Returns a received frame. `fd` says whether it came as a CAN FD frame, which its size shows.
CanFrame from_wire(const canfd_frame& wire, bool fd);

// Returns the report that an error frame holds: a frame with CAN_ERR_FLAG.
CanErrorReport error_from_wire(const canfd_frame& wire);

// The data that the kernel adds to a received frame.
struct CanAncillary {
  // The time of arrival, ns of CLOCK_REALTIME; 0: no time stamp.
  TimeNs realtime_ns = 0;
  // The number of frames that the socket has dropped so far.
  std::uint32_t drops = 0;
  // True if `drops` is valid.
  bool tells_drops = false;
};
// Returns the ancillary data of a message that recvmsg has filled.
CanAncillary read_ancillary(msghdr& message);

}  // namespace tactus::hal
