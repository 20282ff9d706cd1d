// A byte stream to one device: a UART, or the virtual serial port of a USB board.
#pragma once

#include <cstddef>
#include <span>

#include "hal/clock.h"
#include "hal/error.h"

namespace tactus::hal {

// One end of the stream. It has no framing and no acknowledgement, and a real line does not detect
// wrong bytes. The driver must interpret and check the bytes.
//
// Real time: everything but reopen, after opening; nothing is allocated. Thread: one at a time for
// each object; not from an interrupt. Every call can return, besides the errors that it lists:
//   disconnected  the device is gone, until `reopen` succeeds
//   io            anything else the system reports
class SerialPort {
 public:
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  // Puts the bytes into the send buffer, in one piece if they fit, and returns how many it took by
  // the deadline. To take fewer than given is no error. With no bytes given it returns 0 at once.
  // Bytes in the buffer are not sent yet.
  //   timeout  no byte was taken
  Result<std::size_t> write(std::span<const std::byte> bytes, TimeNs deadline_ns);

  // Waits for the first byte, then takes what has arrived without waiting for more. Returns the
  // number of bytes put into `buffer`, at least 1.
  //   timeout           nothing arrived by the deadline
  //   invalid_argument  `buffer` is empty
  Result<std::size_t> read(std::span<std::byte> buffer, TimeNs deadline_ns);

  // Reads until the buffer is full or the deadline has passed. Returns the number of bytes read.
  //   timeout           nothing arrived
  //   invalid_argument  `buffer` is empty
  Result<std::size_t> read_all(std::span<std::byte> buffer, TimeNs deadline_ns);

  // Drops the bytes that have arrived and were not read.
  Result<void> discard_input() { return DoDiscardInput(); }

  // Opens the device again, after it came back or while it is still there. Not real time.
  //   disconnected   it is not there
  //   busy           another program holds it exclusively
  //   not_permitted  no access to the device node
  //   not_supported  it is no serial port, or cannot do these settings
  Result<void> reopen() { return DoReopen(); }

 protected:
  SerialPort() = default;
  ~SerialPort() = default;

 private:
  // The public functions have checked the arguments: there is at least one byte, or room for one.
  virtual Result<std::size_t> DoWrite(std::span<const std::byte> bytes, TimeNs deadline_ns) = 0;
  virtual Result<std::size_t> DoRead(std::span<std::byte> buffer, TimeNs deadline_ns) = 0;
  virtual Result<void> DoDiscardInput() = 0;
  virtual Result<void> DoReopen() = 0;
};

}  // namespace tactus::hal
