// The Haply board's driver and its emulator on a simulated line, ticked at 1 kHz. The arms stand at
// 180 and 0 degrees when it is set up, as the pantograph's do.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

#include "drivers/haply_serial/haply.h"
#include "hal/simulated/clock.h"
#include "host_tools/emulators/haply_serial_peer.h"

namespace tactus::drivers {

inline HaplyConfig pantograph_config() {
  HaplyConfig config;
  config.axis[0].home_rad = std::numbers::pi;
  config.axis[1].home_rad = 0.0;
  config.unproven_watchdog = true;
  return config;
}

struct HaplyRig {
  static constexpr hal::TimeNs kTick_ns = 1'000'000;
  static constexpr hal::TimeNs kReadPatience_ns = 600'000;

  explicit HaplyRig(const HaplyConfig& config = pantograph_config(), std::uint32_t seed = 1)
      : peer(clock, seed), driver(peer.host(), clock, config) {
    peer.emulator().shafts()[0].position_rad = std::numbers::pi;
  }

  host::HaplyEmulator& board() { return peer.emulator(); }
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
  bool arms_feel_nothing() {
    return board().shafts()[0].torque_Nm == 0.0 && board().shafts()[1].torque_Nm == 0.0;
  }

  hal::SimulatedClock clock;
  host::HaplySerialPeer peer;
  Haply driver;
  std::array<AxisSample, kHaplyMaxAxes> samples{};
  std::array<AxisCommand, kHaplyMaxAxes> commands{};
};

}  // namespace tactus::drivers
