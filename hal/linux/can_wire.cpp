#include "hal/linux/can_wire.h"

#include <linux/errqueue.h>

#include <algorithm>
#include <cstring>

#include "hal/linux/system.h"

namespace tactus::hal {

CanWireFrame to_wire(const CanFrame& frame) {
  CanWireFrame wire;
  wire.frame.can_id =
      frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
  wire.frame.len = frame.length;
  if (frame.fd) {
    wire.frame.flags = static_cast<std::uint8_t>((frame.bit_rate_switch ? CANFD_BRS : 0U) |
                                                 (frame.error_state_indicator ? CANFD_ESI : 0U));
  }
  std::memcpy(wire.frame.data, frame.data.data(), frame.bytes().size());
  wire.bytes = frame.fd ? CANFD_MTU : CAN_MTU;
  return wire;
}

CanFrame from_wire(const canfd_frame& wire, bool fd) {
  CanFrame frame;
  frame.extended = (wire.can_id & CAN_EFF_FLAG) != 0;
  frame.remote = (wire.can_id & CAN_RTR_FLAG) != 0;
  frame.id = wire.can_id & (frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame.fd = fd;
  frame.bit_rate_switch = fd && (wire.flags & CANFD_BRS) != 0;
  frame.error_state_indicator = fd && (wire.flags & CANFD_ESI) != 0;
  frame.length = std::min(wire.len, static_cast<std::uint8_t>(fd ? kMaxCanFdBytes : kMaxCanBytes));
  std::memcpy(frame.data.data(), wire.data, frame.bytes().size());
  return frame;
}

CanErrorReport error_from_wire(const canfd_frame& wire) {
  return {.classes = wire.can_id & kCanEveryErrorClass,
          .controller = wire.data[1],
          .protocol_type = wire.data[2],
          .protocol_place = wire.data[3],
          .transceiver = wire.data[4],
          .transmit_errors = wire.data[6],
          .receive_errors = wire.data[7]};
}

CanAncillary read_ancillary(msghdr& message) {
  CanAncillary ancillary;
  for (cmsghdr* item = CMSG_FIRSTHDR(&message); item != nullptr;
       item = CMSG_NXTHDR(&message, item)) {
    if (item->cmsg_level != SOL_SOCKET) {
      continue;
    }
    if (item->cmsg_type == SO_TIMESTAMPING) {
      scm_timestamping stamps{};
      std::memcpy(&stamps, CMSG_DATA(item), sizeof(stamps));
      ancillary.realtime_ns = to_ns(stamps.ts[0]);
    } else if (item->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&ancillary.drops, CMSG_DATA(item), sizeof(ancillary.drops));
      ancillary.tells_drops = true;
    }
  }
  return ancillary;
}

}  // namespace tactus::hal
