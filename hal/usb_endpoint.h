// One claimed USB interface of a device: its control pipe, one bulk-out pipe and one bulk-in pipe.
// A driver takes a reference to UsbEndpoint; libusb (hal/linux/usb_endpoint.h) and the endpoint in
// memory (hal/simulated/usb_endpoint.h) implement it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/clock.h"
#include "hal/error.h"

namespace tactus::hal {

// The largest data of a control transfer, bytes.
inline constexpr std::size_t kMaxUsbControlBytes = 4096;
// The largest number of bulk transfers of an endpoint that are in flight at once.
inline constexpr std::size_t kMaxUsbTransfersInFlight = 16;

// The fields of a control transfer's setup packet (USB 2.0, section 9.3). Its length field is not
// here: it is the size of the data.
struct UsbSetup {
  // bmRequestType: bit 7 is the direction (1: device to host), the rest the kind and the recipient.
  std::uint8_t request_type = 0;
  // bRequest, wValue and wIndex: their meaning depends on the request.
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::uint16_t index = 0;
};

// The presence of the device.
enum class UsbState : std::uint8_t {
  attached,  // open and claimed
  detached,  // gone; every call returns disconnected
  returned,  // plugged in again but not open: call `reopen`
};

// The direction as the host sees it: `out` to the device, `in` from it.
enum class UsbDirection : std::uint8_t { out, in };

// A bulk transfer that may stay in flight across ticks. The caller owns it and its buffer; both
// must stay in place while it is in flight. It may be submitted again when it is done.
class UsbTransfer {
 public:
  // Return a transfer that reads into `buffer`, or one that sends `data`.
  static UsbTransfer in(std::span<std::byte> buffer) { return {UsbDirection::in, buffer, {}}; }
  static UsbTransfer out(std::span<const std::byte> data) { return {UsbDirection::out, {}, data}; }
  UsbTransfer(const UsbTransfer&) = delete;
  UsbTransfer& operator=(const UsbTransfer&) = delete;
  ~UsbTransfer() = default;

  // The state of a transfer: never submitted, in flight, or ended.
  enum class State : std::uint8_t { idle, in_flight, done };
  // Returns `in_flight` from a submit until the transfer has ended, then `done`.
  State state() const { return state_; }
  // Return the direction and the buffer with which the transfer was made. The buffer of the other
  // direction is empty.
  UsbDirection direction() const { return direction_; }
  std::span<std::byte> in_buffer() const { return in_buffer_; }
  std::span<const std::byte> out_data() const { return out_data_; }

  // Returns the bytes transferred so far, also if the transfer failed half way.
  std::size_t transferred() const { return transferred_; }

  // Returns the bytes transferred, or why the transfer failed; invalid_state before it is done.
  Result<std::size_t> result() const;

  // These three are for implementations of UsbEndpoint. begin() marks the transfer as in flight
  // with no bytes transferred; progress() adds bytes; finish() ends it with success or an error.
  void begin();
  void progress(std::size_t bytes) { transferred_ += bytes; }
  void finish(Result<void> outcome);

 private:
  UsbTransfer(UsbDirection direction, std::span<std::byte> buffer, std::span<const std::byte> data)
      : in_buffer_(buffer), out_data_(data), direction_(direction) {}

  std::span<std::byte> in_buffer_;
  std::span<const std::byte> out_data_;
  std::size_t transferred_ = 0;
  Result<void> outcome_;
  State state_ = State::idle;
  UsbDirection direction_;
};

// The claimed interface of one device.
//
// Real time: everything but reopen, after opening; nothing is allocated. Thread: one at a time for
// each object; not from an interrupt. Every call can return, besides the errors that it lists:
//   disconnected   the device is gone
//   io             the transfer failed
//   invalid_state  the device returned but was not reopened
// After an unplug, calls mostly return io first and disconnected some milliseconds later.
class UsbEndpoint {
 public:
  UsbEndpoint(const UsbEndpoint&) = delete;
  UsbEndpoint& operator=(const UsbEndpoint&) = delete;

  // Run a control transfer and return the number of bytes transferred. They end at the deadline.
  //   timeout           the device did not answer
  //   stalled           the device does not know the request or refuses it
  //   overflow          the device answered with more bytes than `buffer` holds
  //   invalid_argument  the setup's direction bit is wrong, or more than kMaxUsbControlBytes
  Result<std::size_t> control_out(const UsbSetup& setup, std::span<const std::byte> data,
                                  TimeNs deadline_ns);
  Result<std::size_t> control_in(const UsbSetup& setup, std::span<std::byte> buffer,
                                 TimeNs deadline_ns);

  // Run a bulk transfer and return the bytes transferred before the deadline; fewer than requested
  // is no error. A bulk-in ends at a short packet; its buffer should hold whole packets. An empty
  // bulk-out sends one empty packet.
  //   timeout           no byte was transferred
  //   stalled           the endpoint is halted
  //   overflow          in only: a packet was longer than the room left
  //   queue_full        kMaxUsbTransfersInFlight are in flight
  //   invalid_argument  in only: the buffer is empty
  Result<std::size_t> bulk_out(std::span<const std::byte> data, TimeNs deadline_ns);
  Result<std::size_t> bulk_in(std::span<std::byte> buffer, TimeNs deadline_ns);

  // Starts a transfer and returns. Transfers of one direction are served in the order of
  // submission. A bulk-in that is submitted before a computation runs during it, so that nobody
  // waits for it afterwards.
  //   queue_full        kMaxUsbTransfersInFlight are in flight
  //   invalid_state     this transfer is in flight already
  //   invalid_argument  a bulk-in with an empty buffer
  Result<void> submit(UsbTransfer& transfer);

  // Waits until the transfer is done and returns its result: the bytes, or an error of bulk_out or
  // bulk_in, or `cancelled`.
  //   timeout        it is still in flight
  //   invalid_state  it was never submitted
  Result<std::size_t> wait(UsbTransfer& transfer, TimeNs deadline_ns);

  // Withdraws a transfer and returns when its buffer is no longer used (Linux: a few USB frames).
  // The transfer is then done: `cancelled`, or finished just before. Does nothing if it is not in
  // flight.
  void cancel(UsbTransfer& transfer);

  // Returns the state. This call also notices arrival and departure.
  UsbState state() { return DoState(); }

  // Opens a device that came back. Does nothing if it is attached. Not real time.
  //   disconnected   it is not back yet
  //   busy           another program has claimed it
  //   not_permitted  no access to the device node
  //   no_memory, io
  Result<void> reopen();

  // Returns the largest packet of the bulk-in pipe, bytes.
  std::size_t max_packet_bytes() const { return DoMaxPacketBytes(); }

 protected:
  UsbEndpoint() = default;
  ~UsbEndpoint() = default;

 private:
  // The public functions have checked the arguments. DoSubmit gets a transfer that has begun; if it
  // succeeds, the transfer is still in that state.
  virtual Result<std::size_t> DoControlOut(const UsbSetup& setup, std::span<const std::byte> data,
                                           TimeNs deadline_ns) = 0;
  virtual Result<std::size_t> DoControlIn(const UsbSetup& setup, std::span<std::byte> buffer,
                                          TimeNs deadline_ns) = 0;
  virtual Result<void> DoSubmit(UsbTransfer& transfer) = 0;
  virtual void DoWait(UsbTransfer& transfer, TimeNs deadline_ns) = 0;  // until done or the deadline
  virtual void DoCancel(UsbTransfer& transfer) = 0;
  virtual UsbState DoState() = 0;
  virtual Result<void> DoReopen() = 0;
  virtual std::size_t DoMaxPacketBytes() const = 0;

  // Submits a transfer, waits for it, and withdraws it at the deadline.
  Result<std::size_t> run(UsbTransfer& transfer, TimeNs deadline_ns);
};

}  // namespace tactus::hal
