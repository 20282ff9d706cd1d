// A byte stream to one device: a UART, or the virtual one of a USB board.
#pragma once

#include <cstddef>
#include <span>

#include "hal/clock.h"
#include "hal/error.h"

namespace tactus::hal {

// No framing, no acknowledgement, and on a real line nothing that finds a wrong byte: what the
// bytes mean, and whether they can be true, is the driver's matter.
//
// Real time: everything but reopen, after opening; nothing is allocated. Thread: one at a time for
// each object; not from an interrupt. Every call can return, besides what it lists:
//   disconnected  the device is gone; so until `reopen` succeeds
//   io            anything else the system reports
class SerialPort {
 public:
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  // Hands over the bytes, in one piece as long as the send buffer has room for them, and returns
  // how many were taken by the deadline; fewer than given is no error. Taken does not mean sent:
  // the line is slower. No bytes are no error either.
  //   timeout  not one byte was taken
  Result<std::size_t> write(std::span<const std::byte> bytes, TimeNs deadline_ns);

  // Waits for the first byte, then returns what is there without waiting for more.
  //   timeout           nothing arrived
  //   invalid_argument  no room given
  Result<std::size_t> read(std::span<std::byte> buffer, TimeNs deadline_ns);

  // Reads until the buffer is full or the deadline has passed; returns how many there are.
  //   timeout           nothing arrived
  //   invalid_argument  no room given
  Result<std::size_t> read_all(std::span<std::byte> buffer, TimeNs deadline_ns);

  // Forgets what has arrived and was not read.
  Result<void> discard_input() { return DoDiscardInput(); }

  // Opens the device that came back, or the same one anew. Not real time.
  //   disconnected   it is not there
  //   busy           another program has it for itself
  //   not_permitted  no access to the device node
  //   not_supported  it is no serial port, or cannot do these settings
  Result<void> reopen() { return DoReopen(); }

 protected:
  SerialPort() = default;
  ~SerialPort() = default;

 private:
  // The arguments have been checked: there is at least one byte, or room for one.
  virtual Result<std::size_t> DoWrite(std::span<const std::byte> bytes, TimeNs deadline_ns) = 0;
  virtual Result<std::size_t> DoRead(std::span<std::byte> buffer, TimeNs deadline_ns) = 0;
  virtual Result<void> DoDiscardInput() = 0;
  virtual Result<void> DoReopen() = 0;
};

}  // namespace tactus::hal
