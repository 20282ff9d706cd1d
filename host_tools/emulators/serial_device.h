// The device's end of a serial line of this machine: a pseudo-terminal, or the tty of a USB gadget.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hal/linux/serial_port.h"

namespace tactus::host {

// Polled by one emulator, without waiting. What arrives is handed out one poll later, when no more
// has come, so that a message that a kernel hands over in two parts is seen whole, as in a device's
// own buffer. Comes back by itself after its tty was hung up, as a gadget's is when its cable is
// pulled.
class SerialDevice final : public hal::SerialPort {
 public:
  SerialDevice() = default;
  SerialDevice(const SerialDevice&) = delete;
  SerialDevice& operator=(const SerialDevice&) = delete;
  ~SerialDevice();

  // Opens a tty. Throws InputError, text for a user, if it cannot be opened.
  void open(const std::string& tty);
  // Makes a pseudo-terminal and returns the path of the host's end, which opens like any tty.
  // Throws InputError too.
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
  int host_end_ = -1;  // held open: a pseudo-terminal is hung up when the last host closes it
  unsigned calls_until_reopen_ = 0;
};

}  // namespace tactus::host
