// The device's end of a serial line of this machine: a pseudo-terminal, or the tty of a USB gadget.
// `tactus emulate haply` uses it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hal/linux/serial_port.h"

namespace tactus::host {

// A port that one emulator polls without waiting. Bytes are handed out one poll later, when no more
// have come, so that a message that the kernel delivers in two parts is seen whole, as in a
// device's own buffer. After its tty was hung up, as a gadget's is when the cable is pulled, it
// opens it again by itself.
class SerialDevice final : public hal::SerialPort {
 public:
  SerialDevice() = default;
  SerialDevice(const SerialDevice&) = delete;
  SerialDevice& operator=(const SerialDevice&) = delete;
  ~SerialDevice();

  // Opens a tty. Throws InputError if it cannot be opened.
  void open(const std::string& tty);
  // Makes a pseudo-terminal and returns the path of the host's end, which opens like any tty.
  // Throws InputError.
  std::string open_pseudo_terminal();

 private:
  hal::Result<std::size_t> DoWrite(std::span<const std::byte> bytes,
                                   hal::TimeNs deadline_ns) override;
  hal::Result<std::size_t> DoRead(std::span<std::byte> buffer, hal::TimeNs deadline_ns) override;
  hal::Result<void> DoDiscardInput() override { return port_.discard_input(); }
  hal::Result<void> DoReopen() override { return port_.reopen(); }
  void note(const hal::Error& error);

  hal::LinuxSerialPort port_;
  std::vector<std::byte> arrived_;
  // The host's end, held open: a pseudo-terminal is hung up when the last host closes it.
  int host_end_ = -1;
  unsigned calls_until_reopen_ = 0;
};

}  // namespace tactus::host
