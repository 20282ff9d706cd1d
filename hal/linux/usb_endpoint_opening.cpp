// Finds, claims and closes the device, and notices its arrival and departure.
#include <algorithm>

#include "hal/linux/libusb_callbacks.h"
#include "hal/linux/usb_endpoint.h"

namespace tactus::hal {

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

int LibusbCallbacks::plugged(libusb_context*, libusb_device* device, libusb_hotplug_event event,
                             void* endpoint) {
  static_cast<LinuxUsbEndpoint*>(endpoint)->note_plug(device,
                                                      event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED);
  return 0;
}

void LibusbCallbacks::descriptor_added(int descriptor, short events, void* endpoint) {
  static_cast<LinuxUsbEndpoint*>(endpoint)->add_descriptor(descriptor, events);
}

void LibusbCallbacks::descriptor_removed(int descriptor, void* endpoint) {
  static_cast<LinuxUsbEndpoint*>(endpoint)->remove_descriptor(descriptor);
}

bool has_libusb() {
  return true;
}

LinuxUsbEndpoint::~LinuxUsbEndpoint() {
  if (context_ == nullptr) {
    return;
  }
  close_device();
  libusb_hotplug_deregister_callback(context_, hotplug_handle_);
  for (const Flight& flight : flights_) {
    libusb_free_transfer(flight.transfer);
  }
  libusb_free_transfer(control_.transfer);
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
  control_.transfer = libusb_alloc_transfer(0);
  bool all_there = control_.transfer != nullptr;
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
  // A kernel driver may have bound to the interface; libusb gives it back when the interface is
  // released.
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

void LinuxUsbEndpoint::add_descriptor(int descriptor, short events) {
  if (polled_.count < polled_.descriptors.size()) {
    polled_.descriptors[polled_.count] = {.fd = descriptor, .events = events, .revents = 0};
    ++polled_.count;
  }
}

void LinuxUsbEndpoint::remove_descriptor(int descriptor) {
  const auto known = std::span(polled_.descriptors).first(polled_.count);
  const auto rest = std::ranges::remove(known, descriptor, &pollfd::fd);
  polled_.count -= rest.size();
}

void LinuxUsbEndpoint::note_plug(libusb_device* device, bool arrived) {
  if (arrived) {
    if (state_ == UsbState::detached) {
      state_ = UsbState::returned;
    }
    return;
  }
  const bool was_ours =
      handle_ != nullptr ? device == libusb_get_device(handle_) : state_ == UsbState::returned;
  if (was_ours) {
    state_ = UsbState::detached;
  }
}

}  // namespace tactus::hal
