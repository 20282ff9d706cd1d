#include "host_tools/emulators/falcon_usb_peer.h"

namespace tactus::host {

FalconUsbPeer::FalconUsbPeer(FalconEmulator& emulator, hal::SimulatedClock& clock)
    : emulator_(emulator),
      clock_(clock),
      endpoint_(clock, *this, {.max_packet_bytes = FalconEmulator::kUsbPacketBytes}) {
  clock_.attach(*this);
}

FalconUsbPeer::~FalconUsbPeer() {
  clock_.detach(*this);
}

void FalconUsbPeer::unplug() {
  emulator_.set_fault(EmulatorFault::unplugged);
  endpoint_.unplug(kDeparture_ns);
}

void FalconUsbPeer::plug_in() {
  emulator_.set_fault(EmulatorFault::none);
  endpoint_.plug_in();
}

hal::Result<std::size_t> FalconUsbPeer::control_out(const hal::UsbSetup& setup,
                                                    std::span<const std::byte> data) {
  if (!emulator_.control(setup.request_type, setup.request, setup.value)) {
    return hal::failure(hal::ErrorCode::stalled);
  }
  return data.size();
}

hal::Result<std::size_t> FalconUsbPeer::control_in(const hal::UsbSetup&, std::span<std::byte>) {
  return hal::failure(hal::ErrorCode::stalled);
}

void FalconUsbPeer::bulk_out(std::span<const std::byte> data) {
  emulator_.receive(clock_.now_ns(), data);
}

// The chip sends only what the host asks for, so an idle packet does not queue up behind others.
void FalconUsbPeer::run_event() {
  const auto packet = emulator_.packet(clock_.now_ns());
  const bool idle = packet.size() <= 2;
  if (!packet.empty() && (!idle || endpoint_.packets_waiting() == 0)) {
    endpoint_.answer(packet);
  }
}

}  // namespace tactus::host
