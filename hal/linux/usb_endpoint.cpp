#include "hal/linux/usb_endpoint.h"

#include <libusb.h>

#include <algorithm>

#include "hal/linux/system.h"

namespace tactus::hal {

namespace {

constexpr TimeNs kWithdrawalRound_ns = 10'000'000;

std::unexpected<Error> libusb_failure(int code) {
  switch (code) {
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
      return failure(ErrorCode::disconnected, code);
    case LIBUSB_ERROR_BUSY:
      return failure(ErrorCode::busy, code);
    case LIBUSB_ERROR_ACCESS:
      return failure(ErrorCode::not_permitted, code);
    case LIBUSB_ERROR_NO_MEM:
      return failure(ErrorCode::no_memory, code);
    default:
      return failure(ErrorCode::io, code);
  }
}

// libusb takes one type for both directions; it does not write to what goes out.
unsigned char* transfer_buffer(const UsbTransfer& transfer) {
  if (transfer.direction() == UsbDirection::in) {
    return reinterpret_cast<unsigned char*>(transfer.in_buffer().data());
  }
  return reinterpret_cast<unsigned char*>(const_cast<std::byte*>(transfer.out_data().data()));
}

int transfer_length(const UsbTransfer& transfer) {
  return static_cast<int>(transfer.direction() == UsbDirection::in ? transfer.in_buffer().size()
                                                                   : transfer.out_data().size());
}

}  // namespace

struct LibusbCallbacks {
  static void bulk_done(libusb_transfer* transfer) {
    auto& flight = *static_cast<LinuxUsbEndpoint::Flight*>(transfer->user_data);
    UsbTransfer& carried = *flight.carried;
    flight.carried = nullptr;
    carried.progress(static_cast<std::size_t>(transfer->actual_length));
    carried.finish(flight.endpoint->outcome_of(*transfer));
  }
  static void control_done(libusb_transfer* transfer) {
    static_cast<LinuxUsbEndpoint*>(transfer->user_data)->control_done_ = true;
  }
  static int plugged(libusb_context*, libusb_device* device, libusb_hotplug_event event,
                     void* endpoint) {
    static_cast<LinuxUsbEndpoint*>(endpoint)->note_plug(
        device, event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED);
    return 0;
  }
  static void descriptor_added(int descriptor, short events, void* endpoint) {
    static_cast<LinuxUsbEndpoint*>(endpoint)->add_descriptor(descriptor, events);
  }
  static void descriptor_removed(int descriptor, void* endpoint) {
    static_cast<LinuxUsbEndpoint*>(endpoint)->remove_descriptor(descriptor);
  }
};

LinuxUsbEndpoint::~LinuxUsbEndpoint() {
  if (context_ == nullptr) {
    return;
  }
  close_device();
  libusb_hotplug_deregister_callback(context_, hotplug_handle_);
  for (const Flight& flight : flights_) {
    libusb_free_transfer(flight.transfer);
  }
  libusb_free_transfer(control_);
  libusb_exit(context_);
}

Result<void> LinuxUsbEndpoint::open(const LinuxUsbConfig& config) {
  if (context_ != nullptr) {
    return failure(ErrorCode::invalid_state);
  }
  config_ = config;
  if (const auto started = start_library(); !started) {
    return started;
  }
  auto opened = open_device();
  if (!opened && opened.error().code == ErrorCode::disconnected) {
    return failure(ErrorCode::not_found, opened.error().errno_value);
  }
  return opened;
}

Result<void> LinuxUsbEndpoint::start_library() {
  if (const int code = libusb_init(&context_); code != LIBUSB_SUCCESS) {
    context_ = nullptr;
    return libusb_failure(code);
  }
  control_ = libusb_alloc_transfer(0);
  bool all_there = control_ != nullptr;
  for (Flight& flight : flights_) {
    flight = {.endpoint = this, .transfer = libusb_alloc_transfer(0), .carried = nullptr};
    all_there = all_there && flight.transfer != nullptr;
  }
  if (const libusb_pollfd** list = libusb_get_pollfds(context_); list != nullptr) {
    for (const libusb_pollfd** item = list; *item != nullptr; ++item) {
      add_descriptor((*item)->fd, (*item)->events);
    }
    libusb_free_pollfds(list);
  }
  libusb_set_pollfd_notifiers(context_, LibusbCallbacks::descriptor_added,
                              LibusbCallbacks::descriptor_removed, this);
  const int code = libusb_hotplug_register_callback(
      context_, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT,
      LIBUSB_HOTPLUG_NO_FLAGS, config_.vendor, config_.product, LIBUSB_HOTPLUG_MATCH_ANY,
      LibusbCallbacks::plugged, this, &hotplug_handle_);
  if (code != LIBUSB_SUCCESS) {
    return libusb_failure(code);
  }
  return all_there ? Result<void>{} : failure(ErrorCode::no_memory);
}

Result<void> LinuxUsbEndpoint::open_device() {
  libusb_device** devices = nullptr;
  const auto count = libusb_get_device_list(context_, &devices);
  if (count < 0) {
    return libusb_failure(static_cast<int>(count));
  }
  Result<void> opened = failure(ErrorCode::disconnected, LIBUSB_ERROR_NOT_FOUND);
  for (libusb_device* device : std::span(devices, static_cast<std::size_t>(count))) {
    if (!opened && is_ours(device)) {
      opened = claim(device);
    }
  }
  libusb_free_device_list(devices, 1);
  state_ = opened ? UsbState::attached : UsbState::detached;
  return opened;
}

bool LinuxUsbEndpoint::is_ours(libusb_device* device) const {
  libusb_device_descriptor descriptor{};
  return libusb_get_device_descriptor(device, &descriptor) == LIBUSB_SUCCESS &&
         descriptor.idVendor == config_.vendor && descriptor.idProduct == config_.product;
}

bool LinuxUsbEndpoint::has_our_serial(libusb_device* device, libusb_device_handle* handle) const {
  if (config_.serial.empty()) {
    return true;
  }
  libusb_device_descriptor descriptor{};
  libusb_get_device_descriptor(device, &descriptor);
  std::array<unsigned char, 128> text{};
  const int length = libusb_get_string_descriptor_ascii(handle, descriptor.iSerialNumber,
                                                        text.data(), static_cast<int>(text.size()));
  return length >= 0 &&
         std::ranges::equal(std::span(text).first(static_cast<std::size_t>(length)), config_.serial,
                            {}, {}, [](char letter) { return static_cast<unsigned char>(letter); });
}

Result<void> LinuxUsbEndpoint::claim(libusb_device* device) {
  libusb_device_handle* handle = nullptr;
  if (const int code = libusb_open(device, &handle); code != LIBUSB_SUCCESS) {
    return libusb_failure(code);
  }
  if (!has_our_serial(device, handle)) {
    libusb_close(handle);
    return failure(ErrorCode::disconnected, LIBUSB_ERROR_NOT_FOUND);
  }
  libusb_set_auto_detach_kernel_driver(handle, 1);
  if (const int code = libusb_claim_interface(handle, config_.interface); code != LIBUSB_SUCCESS) {
    libusb_close(handle);
    return libusb_failure(code);
  }
  handle_ = handle;
  if (const int bytes = libusb_get_max_packet_size(device, config_.endpoint_in); bytes > 0) {
    max_packet_bytes_ = static_cast<std::size_t>(bytes);
  }
  return {};
}

void LinuxUsbEndpoint::close_device() {
  if (handle_ == nullptr) {
    return;
  }
  for (const Flight& flight : flights_) {
    if (flight.carried != nullptr) {
      DoCancel(*flight.carried);
    }
  }
  libusb_release_interface(handle_, config_.interface);
  libusb_close(handle_);
  handle_ = nullptr;
}

Result<void> LinuxUsbEndpoint::DoReopen() {
  if (context_ == nullptr) {
    return failure(ErrorCode::disconnected);
  }
  if (DoState() == UsbState::attached) {
    return {};
  }
  close_device();
  return open_device();
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
  std::ranges::copy(data, control_buffer_.begin() + kControlSetupBytes);
  return run_control(setup, data.size(), deadline_ns);
}

Result<std::size_t> LinuxUsbEndpoint::DoControlIn(const UsbSetup& setup,
                                                  std::span<std::byte> buffer, TimeNs deadline_ns) {
  const auto got = run_control(setup, buffer.size(), deadline_ns);
  if (got) {
    std::ranges::copy(std::span(control_buffer_).subspan(kControlSetupBytes, *got), buffer.begin());
  }
  return got;
}

Result<std::size_t> LinuxUsbEndpoint::run_control(const UsbSetup& setup, std::size_t length,
                                                  TimeNs deadline_ns) {
  if (const auto there = check_present(); !there) {
    return std::unexpected(there.error());
  }
  auto* const bytes = reinterpret_cast<unsigned char*>(control_buffer_.data());
  libusb_fill_control_setup(bytes, setup.request_type, setup.request, setup.value, setup.index,
                            static_cast<std::uint16_t>(length));
  libusb_fill_control_transfer(control_, handle_, bytes, LibusbCallbacks::control_done, this, 0);
  if (const int code = libusb_submit_transfer(control_); code != LIBUSB_SUCCESS) {
    if (code == LIBUSB_ERROR_NO_DEVICE && state_ == UsbState::attached) {
      state_ = UsbState::detached;
    }
    return libusb_failure(code);
  }
  control_done_ = false;
  if (!serve_until(deadline_ns, [this] { return control_done_; })) {
    withdraw(control_, control_done_);
    if (control_->status == LIBUSB_TRANSFER_CANCELLED) {
      return failure(ErrorCode::timeout);
    }
  }
  if (const auto outcome = outcome_of(*control_); !outcome) {
    return std::unexpected(outcome.error());
  }
  return static_cast<std::size_t>(control_->actual_length);
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
        wait_for_descriptors(std::span(descriptors_).first(descriptor_count_), deadline_ns);
    serve();
    if (ready <= 0) {
      return done();
    }
  }
  return true;
}

void LinuxUsbEndpoint::add_descriptor(int descriptor, short events) {
  if (descriptor_count_ < descriptors_.size()) {
    descriptors_[descriptor_count_] = {.fd = descriptor, .events = events, .revents = 0};
    ++descriptor_count_;
  }
}

void LinuxUsbEndpoint::remove_descriptor(int descriptor) {
  const auto known = std::span(descriptors_).first(descriptor_count_);
  const auto rest = std::ranges::remove(known, descriptor, &pollfd::fd);
  descriptor_count_ -= rest.size();
}

void LinuxUsbEndpoint::note_plug(libusb_device* device, bool arrived) {
  if (arrived) {
    if (state_ == UsbState::detached) {
      state_ = UsbState::returned;
    }
  } else if (handle_ != nullptr && device == libusb_get_device(handle_)) {
    state_ = UsbState::detached;
  } else if (handle_ == nullptr && state_ == UsbState::returned) {
    state_ = UsbState::detached;
  }
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
