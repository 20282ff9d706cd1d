// A tty of Linux: /dev/ttyACM0, /dev/ttyUSB0, /dev/ttyS0, or a pseudo-terminal.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "hal/linux/system.h"
#include "hal/serial_port.h"

namespace tactus::hal {

// Raw bytes, eight bits, no parity, no flow control; the tty is held exclusively. The kernel's own
// buffers are those of the driver (4 kB on the way in), so that `discard_input` is complete.
// Closing waits until the device has taken what was written, at most 30 s, unless it is gone: the
// last command before an end gets through.
class LinuxSerialPort final : public SerialPort {
 public:
  // Not real time. `baud` is one of the rates of termios; a board with a USB of its own ignores it.
  //   not_found         no such device node
  //   invalid_argument  no such rate, or a path that is too long
  //   busy, not_permitted, not_supported, io   as in reopen
  Result<void> open(std::string_view path, std::uint32_t baud);

  // Takes over an open descriptor, of the master side of a pseudo-terminal for example, as it is.
  // `reopen` then cannot bring it back.
  void adopt(int descriptor);

 private:
  Result<std::size_t> DoWrite(std::span<const std::byte> bytes, TimeNs deadline_ns) override;
  Result<std::size_t> DoRead(std::span<std::byte> buffer, TimeNs deadline_ns) override;
  Result<void> DoDiscardInput() override;
  Result<void> DoReopen() override;

  Result<void> open_node();
  // An errno of a read, a write or an ioctl; a device that is gone closes the node.
  std::unexpected<Error> failed(int errno_value);
  // Waits until the tty can be read or written. False at the deadline.
  Result<bool> wait_for(short events, TimeNs deadline_ns);

  std::array<char, 256> path_{};
  std::uint32_t speed_ = 0;  // B115200 and so on
  FileDescriptor node_;
};

}  // namespace tactus::hal
