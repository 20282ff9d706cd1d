// Boards of several axes as the drives of a machine, in memory, with the real drivers on the other
// side.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "drivers/haply_serial/haply.h"
#include "hal/simulated/clock.h"
#include "hal/simulated/serial_port.h"
#include "host_tools/emulators/board_devices.h"
#include "host_tools/emulators/emulated_run.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// A pantograph whose board is on a line in memory, and a spring in each joint, 0.1 rad from where
// it stands.
struct PantographOnALine {
  explicit PantographOnALine(const std::vector<PlannedFault>& faults) {
    host_end.connect(device_end);
    EmulatedMachineConfig config;
    config.device = haply_pantograph_preset();
    MechanismPose pose;
    solve_mechanism(PantographLengths{}, config.device.centre_B, pose);
    drivers::HaplyConfig driver_config;
    driver_config.unproven_watchdog = true;
    for (std::size_t i = 0; i < 2; ++i) {
      home_rad[i] = joint_position(PantographLengths{}, i, pose.coordinate[i]);
      driver_config.axis[i].home_rad = home_rad[i];
    }
    machine.emplace(config, clock.now_ns());
    const std::array<drivers::Transmission, 2> transmissions{};
    haply.connect(*machine, transmissions);
    run.emplace(*machine, EmulatedRunConfig{.faults = faults});
    clocked.emplace(*run, clock);
    driver.emplace(host_end, clock, driver_config);
    driver->start();
  }

  void ticks(int count) {
    for (int i = 0; i < count; ++i) {
      driver->read(samples, clock.now_ns() + 800'000);
      for (std::size_t joint = 0; joint < 2; ++joint) {
        const double turn_rad = samples[joint].position_rad - home_rad[joint];
        commands[joint] = {
            .torque_Nm = std::clamp(
                0.5 * (0.1 - turn_rad) - 0.015 * samples[joint].velocity_rad_per_s, -0.1, 0.1),
            .enable = true};
      }
      driver->write(commands);
      next_tick_ns += 1'000'000;
      clock.advance_to(next_tick_ns);
    }
  }

  hal::SimulatedClock clock;
  hal::SimulatedSerialPort host_end{clock};
  hal::SimulatedSerialPort device_end{clock};
  HaplyEmulator board{device_end, 1};
  EmulatedHaply haply{board, nullptr};
  std::optional<EmulatedMachine> machine;
  std::optional<EmulatedRun> run;
  std::optional<ClockedRun> clocked;
  std::optional<drivers::Haply> driver;
  std::array<double, 2> home_rad{};
  std::array<drivers::AxisSample, drivers::kHaplyMaxAxes> samples{};
  std::array<drivers::AxisCommand, drivers::kHaplyMaxAxes> commands{};
  hal::TimeNs next_tick_ns = clock.now_ns();
};

TEST(EmulatedHaply, SpringsHoldThePantographWhereTheDriverSaysItIs) {
  PantographOnALine device({});
  device.ticks(100);
  ASSERT_EQ(device.samples[0].status, drivers::kDeviceOk) << device.driver->trouble(0).what;
  device.ticks(500);
  for (std::size_t i = 0; i < 2; ++i) {
    const MachineTruth& truth = device.machine->truth();
    EXPECT_NEAR(device.samples[i].position_rad, truth.joint_position[i], 1e-3);  // two counts
    EXPECT_NEAR(truth.shaft_torque_Nm[i], device.commands[i].torque_Nm, 1e-7);
    EXPECT_NEAR(truth.joint_position[i], device.home_rad[i] + 0.1, 0.03);
  }
}

TEST(EmulatedHaply, OneFaultIsEveryAxis) {
  PantographOnALine device({parse_planned_fault("0:silent@0.3")});
  device.ticks(290);
  ASSERT_EQ(device.samples[0].status, drivers::kDeviceOk);
  device.ticks(30);
  EXPECT_NE(device.samples[0].status & drivers::kDeviceLost, 0U);
  EXPECT_NE(device.samples[1].status & drivers::kDeviceLost, 0U);
  EXPECT_EQ(device.machine->truth().shaft_torque_Nm[0], 0.0);
  EXPECT_EQ(device.machine->truth().shaft_torque_Nm[1], 0.0);
}

// The board's pins: nobody looks at them.
class NoPins final : public BoardPins {
 public:
  void drive(std::uint32_t, bool) override {}
  bool level(std::uint32_t) override { return false; }
  double pwm_level() override { return 0.0; }
  void unplug() override { is_unplugged = true; }
  bool is_unplugged = false;
};

TEST(EmulatedPaddle, TurnsOneJointAndRefusesMore) {
  NoPins pins;
  drivers::GpioAxisConfig wiring;
  wiring.pins.encoder_a = {.offset = 0};
  wiring.pins.encoder_b = {.offset = 1};
  wiring.encoder.counts_per_rev = 1000;
  GpioAxisEmulator axis(wiring, pins, 1);
  EmulatedPaddle paddle(axis);
  const std::array<drivers::Transmission, 3> transmissions{{{.encoder_ratio = 17.45}}};

  EmulatedMachine cartesian({}, 0);
  EXPECT_THROW(paddle.connect(cartesian, transmissions), InputError);

  EmulatedMachineConfig config;
  config.device = hapkit_preset();
  config.hand = kPenHand;
  config.path = WishPath({{0.0, Vec3::Zero()}, {0.3, {0.01, 0.0, 0.0}}});
  config.origin_B = config.device.centre_B;
  EmulatedMachine machine(config, 0);
  paddle.connect(machine, transmissions);
  machine.run(1'000'000'000);
  // Its handle is on an arc of 65.659 mm; the encoder has counted every step there.
  const double turn_rad = std::asin(machine.truth().handle_p_B.x() / 0.065659);
  EXPECT_GT(turn_rad, 0.1);
  EXPECT_NEAR(axis.shaft().position_rad, 17.45 * turn_rad, 1e-6);
  EXPECT_NEAR(static_cast<double>(axis.count()), 17.45 * turn_rad * 1000.0 / (2.0 * 3.14159265),
              1.0);
  machine.set_fault(0, EmulatorFault::unplugged);
  EXPECT_TRUE(pins.is_unplugged);
}

}  // namespace
}  // namespace tactus::host
