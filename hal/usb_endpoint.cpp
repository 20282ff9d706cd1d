#include "hal/usb_endpoint.h"

namespace tactus::hal {

namespace {

constexpr std::uint8_t kDeviceToHost = 0x80;

// Returns true if the setup's direction bit matches the call and the data is not too large.
bool fits(const UsbSetup& setup, UsbDirection direction, std::size_t bytes) {
  const bool says_in = (setup.request_type & kDeviceToHost) != 0;
  return says_in == (direction == UsbDirection::in) && bytes <= kMaxUsbControlBytes;
}

}  // namespace

Result<std::size_t> UsbTransfer::result() const {
  if (state_ != State::done) {
    return failure(ErrorCode::invalid_state);
  }
  if (!outcome_) {
    return std::unexpected(outcome_.error());
  }
  return transferred_;
}

void UsbTransfer::begin() {
  transferred_ = 0;
  outcome_ = {};
  state_ = State::in_flight;
}

void UsbTransfer::finish(Result<void> outcome) {
  outcome_ = outcome;
  state_ = State::done;
}

Result<std::size_t> UsbEndpoint::control_out(const UsbSetup& setup, std::span<const std::byte> data,
                                             TimeNs deadline_ns) {
  if (!fits(setup, UsbDirection::out, data.size())) {
    return failure(ErrorCode::invalid_argument);
  }
  return DoControlOut(setup, data, deadline_ns);
}

Result<std::size_t> UsbEndpoint::control_in(const UsbSetup& setup, std::span<std::byte> buffer,
                                            TimeNs deadline_ns) {
  if (!fits(setup, UsbDirection::in, buffer.size())) {
    return failure(ErrorCode::invalid_argument);
  }
  return DoControlIn(setup, buffer, deadline_ns);
}

Result<std::size_t> UsbEndpoint::bulk_out(std::span<const std::byte> data, TimeNs deadline_ns) {
  UsbTransfer transfer = UsbTransfer::out(data);
  return run(transfer, deadline_ns);
}

Result<std::size_t> UsbEndpoint::bulk_in(std::span<std::byte> buffer, TimeNs deadline_ns) {
  UsbTransfer transfer = UsbTransfer::in(buffer);
  return run(transfer, deadline_ns);
}

Result<std::size_t> UsbEndpoint::run(UsbTransfer& transfer, TimeNs deadline_ns) {
  if (const auto submitted = submit(transfer); !submitted) {
    return std::unexpected(submitted.error());
  }
  DoWait(transfer, deadline_ns);
  if (transfer.state() == UsbTransfer::State::done) {
    return transfer.result();
  }
  // The deadline has passed. The buffer belongs to the caller again only after the cancellation;
  // the transfer may still have ended well, or carry some bytes, before it was cancelled.
  cancel(transfer);
  const auto result = transfer.result();
  if (result || result.error().code != ErrorCode::cancelled) {
    return result;
  }
  if (transfer.transferred() > 0) {
    return transfer.transferred();
  }
  return failure(ErrorCode::timeout);
}

Result<void> UsbEndpoint::submit(UsbTransfer& transfer) {
  if (transfer.state() == UsbTransfer::State::in_flight) {
    return failure(ErrorCode::invalid_state);
  }
  if (transfer.direction() == UsbDirection::in && transfer.in_buffer().empty()) {
    return failure(ErrorCode::invalid_argument);
  }
  transfer.begin();
  const auto submitted = DoSubmit(transfer);
  if (!submitted) {
    transfer.finish(submitted);
  }
  return submitted;
}

Result<std::size_t> UsbEndpoint::wait(UsbTransfer& transfer, TimeNs deadline_ns) {
  if (transfer.state() == UsbTransfer::State::in_flight) {
    DoWait(transfer, deadline_ns);
  }
  if (transfer.state() == UsbTransfer::State::in_flight) {
    return failure(ErrorCode::timeout);
  }
  return transfer.result();
}

void UsbEndpoint::cancel(UsbTransfer& transfer) {
  if (transfer.state() == UsbTransfer::State::in_flight) {
    DoCancel(transfer);
  }
}

Result<void> UsbEndpoint::reopen() {
  return DoReopen();
}

}  // namespace tactus::hal
