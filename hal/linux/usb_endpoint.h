// A USB interface through libusb-1.0. Errors and threads are those of UsbEndpoint.
#pragma once

#include <poll.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/usb_endpoint.h"

struct libusb_context;
struct libusb_device;
struct libusb_device_handle;
struct libusb_transfer;  // NOLINT(readability-identifier-naming): libusb's name

namespace tactus::hal {

// The device and the interface of it that is claimed.
struct LinuxUsbConfig {
  // The vendor and product number of the device.
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  // The serial number of the device; empty: the first found. The text must outlive the endpoint.
  std::string_view serial;
  // The number of the interface.
  std::uint8_t interface = 0;
  // The addresses of the bulk endpoints; bit 7 is set for `in`.
  std::uint8_t endpoint_out = 0x02;
  std::uint8_t endpoint_in = 0x81;
};

// Returns true if this build has libusb. Without it nothing can be opened: `not_supported`.
[[nodiscard]] bool has_libusb();

// One claimed interface. The device is identified by vendor, product and serial number, so that it
// may come back at another port. An arrival is noticed only if a udev daemon runs; a departure then
// within milliseconds.
//
// Transfers are allocated in `open`, and this class allocates nothing afterwards. libusb itself
// allocates 56 bytes for each submission and frees them at its completion. The class waits by ppoll
// on libusb's descriptors, because libusb's own waits round to milliseconds.
class LinuxUsbEndpoint final : public UsbEndpoint {
 public:
  LinuxUsbEndpoint() = default;
  LinuxUsbEndpoint(const LinuxUsbEndpoint&) = delete;
  LinuxUsbEndpoint& operator=(const LinuxUsbEndpoint&) = delete;
  // NOLINTNEXTLINE(performance-trivially-destructible): it is so in absent/ alone
  ~LinuxUsbEndpoint();

  // Opens the device and detaches a kernel driver from the interface meanwhile. Call once; not real
  // time.
  //   not_found      no such device; call `reopen` when `state` says that it has come
  //   invalid_state  opened already
  //   busy, not_permitted, no_memory, io   see reopen
  Result<void> open(const LinuxUsbConfig& config);

 private:
  // A libusb transfer and the caller's transfer that it carries; free if that is null.
  struct Flight {
    LinuxUsbEndpoint* endpoint = nullptr;
    libusb_transfer* transfer = nullptr;
    UsbTransfer* carried = nullptr;
  };
  static constexpr std::size_t kMaxPollDescriptors = 16;
  static constexpr std::size_t kControlSetupBytes = 8;
  // The transfer for control requests; there is one at a time.
  struct ControlTransfer {
    libusb_transfer* transfer = nullptr;
    // True once libusb has called back.
    bool is_done = true;
    // The setup packet and the data after it.
    std::array<std::byte, kControlSetupBytes + kMaxUsbControlBytes> buffer{};
  };
  // The descriptors on which libusb waits.
  struct PollList {
    std::array<pollfd, kMaxPollDescriptors> descriptors{};
    std::size_t count = 0;
  };

  Result<std::size_t> DoControlOut(const UsbSetup& setup, std::span<const std::byte> data,
                                   TimeNs deadline_ns) override;
  Result<std::size_t> DoControlIn(const UsbSetup& setup, std::span<std::byte> buffer,
                                  TimeNs deadline_ns) override;
  Result<void> DoSubmit(UsbTransfer& transfer) override;
  void DoWait(UsbTransfer& transfer, TimeNs deadline_ns) override;
  void DoCancel(UsbTransfer& transfer) override;
  UsbState DoState() override;
  Result<void> DoReopen() override;
  std::size_t DoMaxPacketBytes() const override { return max_packet_bytes_; }

  // Starts libusb, allocates the transfers and registers the callbacks.
  Result<void> start_library();
  // Claims the first device that fits, and sets the state. `disconnected` if there is none.
  Result<void> open_device();
  Result<void> claim(libusb_device* device);
  // Return true if vendor and product, or the serial number, are the configured ones.
  bool is_ours(libusb_device* device) const;
  bool has_our_serial(libusb_device* device, libusb_device_handle* handle) const;
  // Withdraws all transfers and closes the device.
  void close_device();

  // Returns the error of a device that is gone or not reopened.
  Result<void> check_present() const;
  // Runs the control transfer whose data is in the buffer of control_, and returns the number of
  // bytes.
  Result<std::size_t> run_control(const UsbSetup& setup, std::size_t length, TimeNs deadline_ns);
  // Returns the flight that carries the transfer, or a free one for null; null if there is none.
  Flight* flight_of(const UsbTransfer* transfer);
  // Handles the events of libusb that are there, without waiting.
  void serve();
  // Handles events until `done()` or the deadline. Returns `done()`.
  template <class Done>
  bool serve_until(TimeNs deadline_ns, Done done);
  // Cancels a transfer and waits until libusb has called back, which sets `done`.
  void withdraw(libusb_transfer* transfer, const bool& done);

  // libusb calls its callbacks only from within `serve` and `open_device`.
  friend struct LibusbCallbacks;
  // Keep the list of the descriptors on which libusb waits.
  void add_descriptor(int descriptor, short events);
  void remove_descriptor(int descriptor);
  // Takes the arrival or departure of a device of our vendor and product.
  void note_plug(libusb_device* device, bool arrived);
  // Returns the success or the error of a transfer that has ended.
  Result<void> outcome_of(const libusb_transfer& transfer);

  LinuxUsbConfig config_;
  libusb_context* context_ = nullptr;
  libusb_device_handle* handle_ = nullptr;
  std::array<Flight, kMaxUsbTransfersInFlight> flights_{};
  ControlTransfer control_;
  PollList polled_;
  std::size_t max_packet_bytes_ = 64;
  int hotplug_handle_ = 0;
  UsbState state_ = UsbState::detached;
};

}  // namespace tactus::hal
