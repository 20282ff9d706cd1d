#include "hal/linux/usb_endpoint.h"

#include <algorithm>

#include "hal/linux/libusb_callbacks.h"
#include "hal/linux/system.h"

namespace tactus::hal {

namespace {

// A cancellation takes a few USB frames of 1 ms. It is waited for in rounds of this length, for as
// many as it takes, because the buffer must not be left to a running transfer.
constexpr TimeNs kWithdrawalRound_ns = 10'000'000;

// Returns the buffer as libusb takes it for both directions. It does not write to an outgoing one.
unsigned char* transfer_buffer(const UsbTransfer& transfer) {
  if (transfer.direction() == UsbDirection::in) {
    return reinterpret_cast<unsigned char*>(transfer.in_buffer().data());
  }
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  return reinterpret_cast<unsigned char*>(const_cast<std::byte*>(transfer.out_data().data()));
}

// Returns the size of the buffer, bytes.
int transfer_length(const UsbTransfer& transfer) {
  return static_cast<int>(transfer.direction() == UsbDirection::in ? transfer.in_buffer().size()
                                                                   : transfer.out_data().size());
}

}  // namespace

void LibusbCallbacks::bulk_done(libusb_transfer* transfer) {
  auto& flight = *static_cast<LinuxUsbEndpoint::Flight*>(transfer->user_data);
  UsbTransfer& carried = *flight.carried;
  flight.carried = nullptr;
  carried.progress(static_cast<std::size_t>(transfer->actual_length));
  carried.finish(flight.endpoint->outcome_of(*transfer));
}

void LibusbCallbacks::control_done(libusb_transfer* transfer) {
  static_cast<LinuxUsbEndpoint*>(transfer->user_data)->control_.is_done = true;
}

UsbState LinuxUsbEndpoint::DoState() {
  if (context_ != nullptr) {
    serve();
  }
  return state_;
}

Result<void> LinuxUsbEndpoint::check_present() const {
  switch (state_) {
    case UsbState::attached:
      return {};
    case UsbState::returned:
      return failure(ErrorCode::invalid_state);
    case UsbState::detached:
      break;
  }
  return failure(ErrorCode::disconnected);
}

Result<std::size_t> LinuxUsbEndpoint::DoControlOut(const UsbSetup& setup,
                                                   std::span<const std::byte> data,
                                                   TimeNs deadline_ns) {
  std::ranges::copy(data, control_.buffer.begin() + kControlSetupBytes);
  return run_control(setup, data.size(), deadline_ns);
}

Result<std::size_t> LinuxUsbEndpoint::DoControlIn(const UsbSetup& setup,
                                                  std::span<std::byte> buffer, TimeNs deadline_ns) {
  const auto got = run_control(setup, buffer.size(), deadline_ns);
  if (got) {
    std::ranges::copy(std::span(control_.buffer).subspan(kControlSetupBytes, *got), buffer.begin());
  }
  return got;
}

Result<std::size_t> LinuxUsbEndpoint::run_control(const UsbSetup& setup, std::size_t length,
                                                  TimeNs deadline_ns) {
  if (const auto there = check_present(); !there) {
    return std::unexpected(there.error());
  }
  auto* const bytes = reinterpret_cast<unsigned char*>(control_.buffer.data());
  libusb_fill_control_setup(bytes, setup.request_type, setup.request, setup.value, setup.index,
                            static_cast<std::uint16_t>(length));
  libusb_fill_control_transfer(control_.transfer, handle_, bytes, LibusbCallbacks::control_done,
                               this, 0);
  if (const int code = libusb_submit_transfer(control_.transfer); code != LIBUSB_SUCCESS) {
    if (code == LIBUSB_ERROR_NO_DEVICE && state_ == UsbState::attached) {
      state_ = UsbState::detached;
    }
    return libusb_failure(code);
  }
  control_.is_done = false;
  if (!serve_until(deadline_ns, [this] { return control_.is_done; })) {
    withdraw(control_.transfer, control_.is_done);
    if (control_.transfer->status == LIBUSB_TRANSFER_CANCELLED) {
      return failure(ErrorCode::timeout);
    }
  }
  if (const auto outcome = outcome_of(*control_.transfer); !outcome) {
    return std::unexpected(outcome.error());
  }
  return static_cast<std::size_t>(control_.transfer->actual_length);
}

LinuxUsbEndpoint::Flight* LinuxUsbEndpoint::flight_of(const UsbTransfer* transfer) {
  auto* const found = std::ranges::find(flights_, transfer, &Flight::carried);
  return found == flights_.end() ? nullptr : found;
}

Result<void> LinuxUsbEndpoint::DoSubmit(UsbTransfer& transfer) {
  if (const auto there = check_present(); !there) {
    return there;
  }
  Flight* const flight = flight_of(nullptr);
  if (flight == nullptr) {
    return failure(ErrorCode::queue_full);
  }
  const bool in = transfer.direction() == UsbDirection::in;
  libusb_fill_bulk_transfer(
      flight->transfer, handle_, in ? config_.endpoint_in : config_.endpoint_out,
      transfer_buffer(transfer), transfer_length(transfer), LibusbCallbacks::bulk_done, flight, 0);
  if (const int code = libusb_submit_transfer(flight->transfer); code != LIBUSB_SUCCESS) {
    if (code != LIBUSB_ERROR_NO_DEVICE) {
      return failure(ErrorCode::io, code);
    }
    if (state_ == UsbState::attached) {
      state_ = UsbState::detached;
    }
    return libusb_failure(code);
  }
  flight->carried = &transfer;
  return {};
}

void LinuxUsbEndpoint::DoWait(UsbTransfer& transfer, TimeNs deadline_ns) {
  serve_until(deadline_ns, [&transfer] { return transfer.state() == UsbTransfer::State::done; });
}

void LinuxUsbEndpoint::DoCancel(UsbTransfer& transfer) {
  Flight* const flight = flight_of(&transfer);
  if (flight == nullptr) {
    return;
  }
  libusb_cancel_transfer(flight->transfer);
  const auto done = [flight, &transfer] { return flight->carried != &transfer; };
  while (!serve_until(monotonic_now_ns() + kWithdrawalRound_ns, done)) {
  }
}

void LinuxUsbEndpoint::withdraw(libusb_transfer* transfer, const bool& done) {
  libusb_cancel_transfer(transfer);
  while (!serve_until(monotonic_now_ns() + kWithdrawalRound_ns, [&done] { return done; })) {
  }
}

void LinuxUsbEndpoint::serve() {
  timeval at_once{};
  libusb_handle_events_timeout_completed(context_, &at_once, nullptr);
}

template <class Done>
bool LinuxUsbEndpoint::serve_until(TimeNs deadline_ns, Done done) {
  serve();
  while (!done()) {
    const int ready =
        wait_for_descriptors(std::span(polled_.descriptors).first(polled_.count), deadline_ns);
    serve();
    if (ready <= 0) {
      return done();
    }
  }
  return true;
}

Result<void> LinuxUsbEndpoint::outcome_of(const libusb_transfer& transfer) {
  switch (transfer.status) {
    case LIBUSB_TRANSFER_COMPLETED:
      return {};
    case LIBUSB_TRANSFER_CANCELLED:
      return failure(ErrorCode::cancelled);
    case LIBUSB_TRANSFER_TIMED_OUT:
      return failure(ErrorCode::timeout, LIBUSB_ERROR_TIMEOUT);
    case LIBUSB_TRANSFER_STALL:
      return failure(ErrorCode::stalled, LIBUSB_ERROR_PIPE);
    case LIBUSB_TRANSFER_OVERFLOW:
      return failure(ErrorCode::overflow, LIBUSB_ERROR_OVERFLOW);
    case LIBUSB_TRANSFER_NO_DEVICE:
      if (state_ == UsbState::attached) {
        state_ = UsbState::detached;
      }
      return failure(ErrorCode::disconnected, LIBUSB_ERROR_NO_DEVICE);
    case LIBUSB_TRANSFER_ERROR:
      break;
  }
  return failure(ErrorCode::io, LIBUSB_ERROR_IO);
}

}  // namespace tactus::hal
