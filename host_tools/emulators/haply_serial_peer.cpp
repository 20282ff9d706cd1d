#include "host_tools/emulators/haply_serial_peer.h"

namespace tactus::host {

HaplySerialPeer::HaplySerialPeer(hal::SimulatedClock& clock, std::uint32_t seed)
    : clock_(clock), host_(clock), device_(clock), emulator_(device_, seed) {
  host_.connect(device_);
  clock_.attach(*this);
}

HaplySerialPeer::~HaplySerialPeer() {
  clock_.detach(*this);
}

void HaplySerialPeer::run_event() {
  next_ns_ = clock_.now_ns() + kPoll_ns;
  emulator_.run(clock_.now_ns());
}

void HaplySerialPeer::unplug() {
  emulator_.set_fault(EmulatorFault::unplugged);
  host_.unplug();
}

void HaplySerialPeer::plug_in() {
  emulator_.set_fault(EmulatorFault::none);
  host_.plug_in();
}

}  // namespace tactus::host
