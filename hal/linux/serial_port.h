// A tty of Linux: /dev/ttyACM0, /dev/ttyUSB0, /dev/ttyS0, or a pseudo-terminal. Errors and threads
// are those of SerialPort.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "hal/linux/system.h"
#include "hal/serial_port.h"

namespace tactus::hal {

// An open tty. It transfers raw bytes with eight bits, no parity and no flow control, and holds the
// tty exclusively. The kernel has only the driver's buffers (4 kB for input), so `discard_input`
// drops everything. Closing waits until the device has taken the written bytes, at most 30 s,
// unless it is gone, so that the last command arrives.
class LinuxSerialPort final : public SerialPort {
 public:
  // Opens a tty. `baud` is one of the rates of termios; a board with its own USB ignores it. Not
  // real time.
  //   not_found         no such device node
  //   invalid_argument  no such rate, or the path is too long
  //   busy, not_permitted, not_supported, io   see reopen
  Result<void> open(std::string_view path, std::uint32_t baud);

  // Takes over an open descriptor with its settings, for example of the master side of a
  // pseudo-terminal. `reopen` then fails.
  void adopt(int descriptor);

 private:
  Result<std::size_t> DoWrite(std::span<const std::byte> bytes, TimeNs deadline_ns) override;
  Result<std::size_t> DoRead(std::span<std::byte> buffer, TimeNs deadline_ns) override;
  Result<void> DoDiscardInput() override;
  Result<void> DoReopen() override;

  // Opens the node of `path_` and sets its speed.
  Result<void> open_node();
  // Converts the errno of a read, a write or an ioctl. Closes the node if the device is gone.
  std::unexpected<Error> failed(int errno_value);
  // Waits until the tty can be read or written. Returns false at the deadline.
  Result<bool> wait_for(short events, TimeNs deadline_ns);

  // The path of the node, ended by a zero; empty after adopt().
  std::array<char, 256> path_{};
  // A constant of termios, such as B115200.
  std::uint32_t speed_ = 0;
  FileDescriptor node_;
};

}  // namespace tactus::hal
