// The emulated Falcon on a USB bus in memory, for tests in simulated time.
#pragma once

#include "hal/simulated/usb_endpoint.h"
#include "host_tools/emulators/falcon_emulator.h"

namespace tactus::host {

// Attaches itself to the clock; emulator and clock must outlive it. For the fault `unplugged` call
// unplug(), which the host sees as on Linux: first an I/O error, then `disconnected`.
class FalconUsbPeer final : public hal::SimulatedUsbPeer, private hal::SimulatedEventSource {
 public:
  // The time from the first I/O error to `disconnected`.
  static constexpr hal::TimeNs kDeparture_ns = 3'000'000;

  FalconUsbPeer(FalconEmulator& emulator, hal::SimulatedClock& clock);
  FalconUsbPeer(const FalconUsbPeer&) = delete;
  FalconUsbPeer& operator=(const FalconUsbPeer&) = delete;
  ~FalconUsbPeer();

  // Returns the host's end.
  [[nodiscard]] hal::SimulatedUsbEndpoint& endpoint() { return endpoint_; }
  // Pulls the plug, and puts it in again.
  void unplug();
  void plug_in();

 private:
  hal::Result<std::size_t> control_out(const hal::UsbSetup& setup,
                                       std::span<const std::byte> data) override;
  hal::Result<std::size_t> control_in(const hal::UsbSetup& setup,
                                      std::span<std::byte> buffer) override;
  void bulk_out(std::span<const std::byte> data) override;

  hal::TimeNs next_event_ns() const override { return emulator_.next_packet_ns(); }
  void run_event() override;

  FalconEmulator& emulator_;
  hal::SimulatedClock& clock_;
  hal::SimulatedUsbEndpoint endpoint_;
};

}  // namespace tactus::host
