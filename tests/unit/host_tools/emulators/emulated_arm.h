// A whole WoodenHaptics of three emulated drives on a simulated CAN bus, driven by the real driver
// at 1 kHz.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "drivers/composition/can_board.h"
#include "hal/simulated/can_bus.h"
#include "hal/simulated/can_network.h"
#include "host_tools/emulators/emulated_run.h"

namespace tactus::host {
inline constexpr hal::TimeNs kArmTick_ns = 1'000'000;
inline constexpr std::array kArmRatios = {16.0, 12.0, 12.0};
inline constexpr std::array kArmDirections = {1.0, -1.0, 1.0};
inline constexpr double kArmLimit_Nm = 0.15;  // that the drivers are to clamp to

// The parts that differ between kinds of drives: how to make driver and emulator 0, 1 and 2, and
// the network.
template <class Driver>
struct ArmDrives {
  std::function<Driver(std::uint8_t)> driver;
  std::function<std::unique_ptr<CanEmulator>(hal::CanBus&, std::uint8_t)> emulator;
  hal::SimulatedCanNetworkConfig network{.bit_rate = 1'000'000};
};

template <class Driver>
struct EmulatedArm {
  explicit EmulatedArm(const ArmDrives<Driver>& kind, const std::vector<PlannedFault>& faults = {},
                       const HandParameters& hand = {})
      : network(clock, kind.network) {
    EmulatedMachineConfig config;
    config.device = woodenhaptics_preset();
    config.hand = hand;
    config.origin_B = config.device.centre_B;
    machine.emplace(config, clock.now_ns());
    for (std::uint8_t i = 0; i < 3; ++i) {
      transmissions[i] = {.motor_ratio = kArmRatios[i],
                          .encoder_ratio = kArmRatios[i],
                          .motor_direction = kArmDirections[i],
                          .encoder_direction = kArmDirections[i],
                          .offset = 0.1 * i};
      nodes.push_back(std::make_unique<hal::SimulatedCanBus>(network));
      drives.push_back(kind.emulator(*nodes.back(), i));
      CanEmulator* const drive = drives.back().get();
      machine->connect({.shaft = &drive->shaft(),
                        .transmission = transmissions[i],
                        .set_fault = [drive](EmulatorFault fault) { drive->set_fault(fault); }});
      machine->add_device([drive](hal::TimeNs now_ns) { drive->run(now_ns); });
      EXPECT_TRUE(board.add(kind.driver(i)));
    }
    MechanismPose pose;
    solve_mechanism(kWoodenLengths, config.device.centre_B, pose);
    for (std::size_t i = 0; i < 3; ++i) {
      middle[i] = joint_position(kWoodenLengths, i, pose.coordinate[i]);
    }
    run.emplace(*machine, EmulatedRunConfig{.faults = faults, .truth_period_ns = 100'000});
    clocked.emplace(*run, clock);
    next_tick_ns = clock.now_ns();
    board.start();
  }

  // `act(tick)` sets the commands from the samples.
  template <class Act>
  void ticks(int count, Act act) {
    for (int i = 0; i < count; ++i) {
      clock.advance_to(next_tick_ns);
      board.read(samples, clock.now_ns() + 600'000);
      act(i);
      board.write(commands);
      next_tick_ns += kArmTick_ns;
    }
  }
  void ticks(int count) {
    ticks(count, [](int) {});
  }

  [[nodiscard]] double joint(std::size_t i) const {
    return drivers::joint_position(transmissions[i], samples[i].position_rad);
  }
  // A spring and a damper to the middle of the workspace, or beside it.
  void hold(const std::array<double, 3>& beside = {}) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double velocity =
          drivers::joint_velocity(transmissions[i], samples[i].velocity_rad_per_s);
      const double effort_Nm = 20.0 * (middle[i] + beside[i] - joint(i)) - 0.3 * velocity;
      const double torque_Nm = std::clamp(drivers::motor_torque_Nm(transmissions[i], effort_Nm),
                                          -kArmLimit_Nm, kArmLimit_Nm);
      commands[i] = {.torque_Nm = torque_Nm, .enable = true};
    }
  }
  [[nodiscard]] bool are_well() const {
    return std::ranges::all_of(samples, [](const drivers::AxisSample& sample) {
      return sample.status == drivers::kDeviceOk;
    });
  }
  [[nodiscard]] double seconds() const {
    return 1e-9 * static_cast<double>(clock.now_ns() - machine->start_ns());
  }
  // The newest truth that is not younger.
  [[nodiscard]] const MachineTruth& truth_at(hal::TimeNs time_ns) const {
    const auto after = std::ranges::upper_bound(run->truth(), time_ns, {}, &MachineTruth::time_ns);
    return after == run->truth().begin() ? *after : *std::prev(after);
  }

  hal::SimulatedClock clock;
  hal::SimulatedCanNetwork network;
  hal::SimulatedCanBus host{network};
  drivers::CanBoard<Driver> board{host, clock};
  std::optional<EmulatedMachine> machine;
  std::vector<std::unique_ptr<hal::SimulatedCanBus>> nodes;
  std::vector<std::unique_ptr<CanEmulator>> drives;
  std::array<drivers::Transmission, 3> transmissions{};
  std::optional<EmulatedRun> run;
  std::optional<ClockedRun> clocked;
  std::array<double, 3> middle{};  // of the workspace, in joints
  std::array<drivers::AxisSample, 3> samples{};
  std::array<drivers::AxisCommand, 3> commands{};
  hal::TimeNs next_tick_ns = 0;
};

}  // namespace tactus::host
