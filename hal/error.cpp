#include "hal/error.h"

namespace tactus::hal {

std::string_view words(ErrorCode code) {
  switch (code) {
    case ErrorCode::timeout:
      return "the deadline passed";
    case ErrorCode::queue_full:
      return "the send queue is full";
    case ErrorCode::link_down:
      return "the network interface is down";
    case ErrorCode::bus_off:
      return "the CAN controller is off the bus";
    case ErrorCode::disconnected:
      return "the device is gone";
    case ErrorCode::io:
      return "the transfer failed";
    case ErrorCode::stalled:
      return "the device refused the request";
    case ErrorCode::overflow:
      return "the device sent more than asked for";
    case ErrorCode::cancelled:
      return "the transfer was cancelled";
    case ErrorCode::busy:
      return "somebody else holds it";
    case ErrorCode::not_permitted:
      return "no permission";
    case ErrorCode::not_found:
      return "no such device, chip or line";
    case ErrorCode::not_supported:
      return "not supported here";
    case ErrorCode::invalid_argument:
      return "a value is out of range";
    case ErrorCode::invalid_state:
      return "not possible in this state";
    case ErrorCode::no_memory:
      return "the system is out of memory";
  }
  return "unknown error";
}

}  // namespace tactus::hal
