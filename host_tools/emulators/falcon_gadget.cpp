#include "host_tools/emulators/falcon_gadget.h"

namespace tactus::host {

FalconGadget::FalconGadget(const FalconEmulatorConfig& config, std::uint32_t seed,
                           const GadgetPlace& place)
    : emulator_(config, seed), gadget_(*this, place) {}

void FalconGadget::plug_in() {
  with_emulator([](FalconEmulator& emulator) { emulator.set_fault(EmulatorFault::none); });
  gadget_.plug_in();
}

void FalconGadget::unplug() {
  with_emulator([](FalconEmulator& emulator) { emulator.set_fault(EmulatorFault::unplugged); });
  gadget_.unplug();
}

bool FalconGadget::control_out(const hal::UsbSetup& setup) {
  return emulator_.control(setup.request_type, setup.request, setup.value);
}

std::optional<std::vector<std::byte>> FalconGadget::control_in(const hal::UsbSetup&) {
  return std::nullopt;
}

void FalconGadget::bulk_out(hal::TimeNs now_ns, std::span<const std::byte> bytes) {
  emulator_.receive(now_ns, bytes);
}

hal::TimeNs FalconGadget::next_packet_ns() {
  return emulator_.next_packet_ns();
}

std::vector<std::byte> FalconGadget::packet(hal::TimeNs now_ns) {
  return emulator_.packet(now_ns);
}

}  // namespace tactus::host
