// The emulated Haply board on a serial line in memory, for tests in simulated time.
#pragma once

#include "hal/simulated/serial_port.h"
#include "host_tools/emulators/haply_emulator.h"

namespace tactus::host {

// Attaches itself to the clock, which must outlive it. For the fault `unplugged` call unplug().
class HaplySerialPeer final : private hal::SimulatedEventSource {
 public:
  // How often the firmware polls its line.
  static constexpr hal::TimeNs kPoll_ns = 50'000;

  HaplySerialPeer(hal::SimulatedClock& clock, std::uint32_t seed);
  HaplySerialPeer(const HaplySerialPeer&) = delete;
  HaplySerialPeer& operator=(const HaplySerialPeer&) = delete;
  ~HaplySerialPeer();

  // Returns the board, for its faults and shafts.
  [[nodiscard]] HaplyEmulator& emulator() { return emulator_; }
  // Returns the host's end of the line.
  [[nodiscard]] hal::SimulatedSerialPort& host() { return host_; }
  // Pulls the plug, and puts it in again.
  void unplug();
  void plug_in();

 private:
  hal::TimeNs next_event_ns() const override { return next_ns_; }
  void run_event() override;

  hal::SimulatedClock& clock_;
  hal::SimulatedSerialPort host_;
  hal::SimulatedSerialPort device_;
  HaplyEmulator emulator_;
  hal::TimeNs next_ns_ = 0;
};

}  // namespace tactus::host
