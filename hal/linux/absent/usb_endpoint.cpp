// LinuxUsbEndpoint of a build without libusb: nothing can be opened.
#include "hal/linux/usb_endpoint.h"

namespace tactus::hal {
namespace {

constexpr Error kNoLibusb{ErrorCode::not_supported, 0};

}  // namespace

bool has_libusb() {
  return false;
}

LinuxUsbEndpoint::~LinuxUsbEndpoint() = default;

Result<void> LinuxUsbEndpoint::open(const LinuxUsbConfig& /*config*/) {
  return std::unexpected(kNoLibusb);
}

Result<std::size_t> LinuxUsbEndpoint::DoControlOut(const UsbSetup& /*setup*/,
                                                   std::span<const std::byte> /*data*/,
                                                   TimeNs /*deadline_ns*/) {
  return std::unexpected(kNoLibusb);
}

Result<std::size_t> LinuxUsbEndpoint::DoControlIn(const UsbSetup& /*setup*/,
                                                  std::span<std::byte> /*buffer*/,
                                                  TimeNs /*deadline_ns*/) {
  return std::unexpected(kNoLibusb);
}

Result<void> LinuxUsbEndpoint::DoSubmit(UsbTransfer& /*transfer*/) {
  return std::unexpected(kNoLibusb);
}

void LinuxUsbEndpoint::DoWait(UsbTransfer& /*transfer*/, TimeNs /*deadline_ns*/) {}

void LinuxUsbEndpoint::DoCancel(UsbTransfer& /*transfer*/) {}

UsbState LinuxUsbEndpoint::DoState() {
  return state_;
}

Result<void> LinuxUsbEndpoint::DoReopen() {
  return std::unexpected(kNoLibusb);
}

}  // namespace tactus::hal
