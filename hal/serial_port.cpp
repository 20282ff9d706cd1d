#include "hal/serial_port.h"

namespace tactus::hal {

Result<std::size_t> SerialPort::write(std::span<const std::byte> bytes, TimeNs deadline_ns) {
  if (bytes.empty()) {
    return std::size_t{0};
  }
  return DoWrite(bytes, deadline_ns);
}

Result<std::size_t> SerialPort::read(std::span<std::byte> buffer, TimeNs deadline_ns) {
  if (buffer.empty()) {
    return failure(ErrorCode::invalid_argument);
  }
  return DoRead(buffer, deadline_ns);
}

Result<std::size_t> SerialPort::read_all(std::span<std::byte> buffer, TimeNs deadline_ns) {
  std::size_t got = 0;
  do {
    const auto more = read(buffer.subspan(got), deadline_ns);
    if (!more) {
      // Bytes that have come before the deadline are the result; only none at all is a timeout.
      const bool enough = got > 0 && more.error().code == ErrorCode::timeout;
      return enough ? Result<std::size_t>(got) : more;
    }
    got += *more;
  } while (got < buffer.size());
  return got;
}

}  // namespace tactus::hal
