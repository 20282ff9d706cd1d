// The error codes of all hal interfaces. Start-up and I/O return them in a Result; nothing throws.
#pragma once

#include <cstdint>
#include <expected>
#include <string_view>

namespace tactus::hal {

// A cause to which a caller reacts. `words` gives its text for the user.
enum class ErrorCode : std::uint8_t {
  timeout,           // the deadline passed before anything was done
  queue_full,        // a send queue has no room: the frame was not taken; try again next tick
  link_down,         // the network interface is down; it may come back
  bus_off,           // the CAN controller left the bus after too many errors; see CanBus::restart
  disconnected,      // the device or chip is gone
  io,                // the transfer failed; on USB often the first sign of an unplug
  stalled,           // the USB device refused the request
  overflow,          // the peer sent more than the buffer holds; the data is lost
  cancelled,         // the caller withdrew the transfer
  busy,              // another program holds the line, the interface or the channel
  not_permitted,     // the process lacks the right; see the udev rules and capabilities
  not_found,         // no such device, chip or line
  not_supported,     // this board or this configuration cannot do it
  invalid_argument,  // a value is out of its range: an error in the caller
  invalid_state,     // a call is out of order: an error in the caller
  no_memory,         // the system had no memory left; only while opening
};

// Why a call failed.
struct Error {
  ErrorCode code = ErrorCode::io;
  // The original error, for the log: errno (> 0) of a system call, LIBUSB_ERROR_* (< 0), or 0.
  int errno_value = 0;

  friend constexpr bool operator==(const Error&, const Error&) = default;
};

template <class T>
// The value of a call, or why it failed.
using Result = std::expected<T, Error>;

// Returns the failed Result of `code`: return failure(ErrorCode::timeout).
constexpr std::unexpected<Error> failure(ErrorCode code, int errno_value = 0) {
  return std::unexpected(Error{code, errno_value});
}

// Returns a short text for the user, without a full stop: "the deadline passed". Any thread.
std::string_view words(ErrorCode code);

}  // namespace tactus::hal
