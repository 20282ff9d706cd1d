#include "drivers/cia402_can/canopen.h"

#include "drivers/common/little_endian.h"

namespace tactus::drivers::canopen {

namespace {

std::uint8_t byte_of(const hal::CanFrame& frame, std::size_t at) {
  return std::to_integer<std::uint8_t>(frame.data[at]);
}

}  // namespace

bool is_from(const hal::CanFrame& frame, std::uint32_t service, std::uint8_t node) {
  return frame.id == service + node && !frame.extended && !frame.remote && !frame.fd &&
         frame.length <= hal::kMaxCanBytes;
}

hal::CanFrame nmt_frame(NmtCommand command, std::uint8_t node) {
  hal::CanFrame frame{.id = kNmt, .length = 2};
  frame.data[0] = static_cast<std::byte>(command);
  frame.data[1] = static_cast<std::byte>(node);
  return frame;
}

hal::CanFrame sync_frame() {
  return {.id = kSync, .length = 0};
}

hal::CanFrame heartbeat_frame(std::uint8_t node, NmtState state) {
  hal::CanFrame frame{.id = kHeartbeat + node, .length = 1};
  frame.data[0] = static_cast<std::byte>(state);
  return frame;
}

std::optional<NmtState> heartbeat_of(const hal::CanFrame& frame, std::uint8_t node) {
  if (!is_from(frame, kHeartbeat, node) || frame.length != 1) {
    return std::nullopt;
  }
  return static_cast<NmtState>(byte_of(frame, 0));
}

std::optional<Emergency> emergency_of(const hal::CanFrame& frame, std::uint8_t node) {
  if (!is_from(frame, kEmergency, node) || frame.length != 8) {
    return std::nullopt;
  }
  Emergency emergency{.code = load_little_endian<std::uint16_t>(frame.data, 0),
                      .error_register = byte_of(frame, 2)};
  for (std::size_t i = 0; i < emergency.vendor.size(); ++i) {
    emergency.vendor[i] = byte_of(frame, 3 + i);
  }
  return emergency;
}

}  // namespace tactus::drivers::canopen
