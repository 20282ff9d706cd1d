// An open line to a board: a tty of this machine, a pseudo-terminal, or an emulator's Unix socket.
// One thread at a time; not real time.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "hal/clock.h"
#include "hal/linux/system.h"
#include "host_tools/serial/serial_place.h"

namespace tactus::host {

// The line. A tty transfers raw bytes: eight bits, no parity, one stop bit, no flow control. While
// it is open no other program can use the tty.
class SerialLine {
 public:
  // Opens the place, and drops what a tty has received before. Throws UnreachableError, whose text
  // names the place, the cause and the remedy.
  explicit SerialLine(const SerialPlace& place);

  // Returns how many bytes came, after waiting for the first no longer than until the deadline; 0
  // if none did. Throws UnreachableError if the other end is gone.
  std::size_t read(std::span<std::byte> buffer, hal::TimeNs deadline_ns);
  // Writes all bytes. Throws UnreachableError if the line does not take them within a second, or
  // the other end is gone.
  void write(std::span<const std::byte> bytes);

  // Returns the path of the tty or socket.
  [[nodiscard]] const std::string& name() const { return place_.path; }
  [[nodiscard]] std::uint32_t baud() const { return place_.baud; }

 private:
  // Waits until the line can be read or written, POLLIN or POLLOUT. Returns false at the deadline.
  [[nodiscard]] bool wait_for(short events, hal::TimeNs deadline_ns) const;
  // Throws UnreachableError with the place and `why`.
  [[noreturn]] void lost(std::string_view why) const;

  SerialPlace place_;
  hal::FileDescriptor file_;
};

}  // namespace tactus::host
