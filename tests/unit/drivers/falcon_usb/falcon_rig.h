// The Falcon's driver and its emulator on a simulated bus, ticked at 1 kHz.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/falcon_usb/falcon.h"
#include "hal/simulated/clock.h"
#include "host_tools/emulators/falcon_emulator.h"
#include "host_tools/emulators/falcon_usb_peer.h"

namespace tactus::drivers {

struct FalconRig {
  static constexpr hal::TimeNs kTick_ns = 1'000'000;
  static constexpr hal::TimeNs kReadPatience_ns = 600'000;

  static FalconConfig accepted(FalconConfig config) {
    config.unproven_watchdog = true;
    return config;
  }
  explicit FalconRig(const host::FalconEmulatorConfig& device = {.homed = true},
                     const FalconConfig& config = {}, std::uint32_t seed = 1)
      : emulator(device, seed),
        peer(emulator, clock),
        driver(peer.endpoint(), clock, accepted(config)) {
    for (host::EmulatedShaft& shaft : emulator.shafts()) {
      shaft.position_rad = 0.5;
    }
  }

  void tick() {
    const hal::TimeNs start_ns = clock.now_ns();
    driver.read(samples, start_ns + kReadPatience_ns);
    driver.write(commands);
    clock.advance_to(start_ns + kTick_ns);
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) {
      tick();
    }
  }
  // True if the driver comes to that status within so many ticks.
  bool tick_until(std::uint32_t status, int count) {
    for (int i = 0; i < count && samples[0].status != status; ++i) {
      tick();
    }
    return samples[0].status == status;
  }
  void command(double torque_Nm) { commands.fill({.torque_Nm = torque_Nm, .enable = true}); }
  bool device_feels_nothing() const { return emulator.motors() == std::array<std::int16_t, 3>{}; }

  hal::SimulatedClock clock;
  host::FalconEmulator emulator;
  host::FalconUsbPeer peer;
  Falcon driver;
  std::array<AxisSample, kFalconArms> samples{};
  std::array<AxisCommand, kFalconArms> commands{};
};

}  // namespace tactus::drivers
