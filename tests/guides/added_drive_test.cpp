// A drive that was added by the guide of drivers/README.md alone: device.toml knows it, and it
// works on a CAN bus in memory.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>

#include "drivers/composition/registered_can_board.h"
#include "drivers/pivot_can/pivot_protocol.h"
#include "firmware/device_file/bus_load.h"
#include "hal/simulated/can_bus.h"
#include "hal/simulated/can_network.h"
#include "hal/simulated/clock.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/input_error.h"

namespace tactus {
namespace {

constexpr hal::TimeNs kMs = 1'000'000;

std::string device(const std::string& axis_keys, const std::string& driver = "pivot_can") {
  return "[mechanism]\nkind = \"hapkit\"\n"
         "[[connection]]\nname = \"bus\"\nkind = \"can\"\ninterface = \"can0\"\n"
         "[[axis]]\nname = \"motor\"\nconnection = \"bus\"\ndriver = \"" +
         driver + "\"\n" + axis_keys +
         "[[joint]]\nname = \"paddle\"\nmotor = \"motor\"\nreference = \"known_pose\"\n";
}

host::LoadedDevice bake(const std::string& text) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "pivot.toml";
  std::ofstream(file) << text;
  return host::bake_device(file);
}

std::string complaint(const std::string& text) {
  try {
    (void)bake(text);
  } catch (const host::InputError& error) {
    return error.what();
  }
  return "bakes";
}

TEST(AddedDrive, IsReadFromADeviceFile) {
  const auto baked = bake(device("node = 3\nmax_torque_Nm = 0.25\nunproven_watchdog = true\n"));
  const auto& drive = std::get<drivers::PivotConfig>(baked.config().axes[0].drive);
  EXPECT_EQ(drive.node, 3);
  EXPECT_EQ(drive.max_torque_Nm, 0.25);
  // 75 and 95 bits a tick: 8 n + 44 + floor((34 + 8 n - 1) / 4) and three bits of space.
  EXPECT_NEAR(firmware::bus_load(baked.config(), 0), 1000.0 * (75.0 + 95.0) / 1e6, 1e-12);
}

TEST(AddedDrive, IsNamedWithTheOthers) {
  EXPECT_TRUE(complaint(device("", "pivot")).contains("\"pivot_can\""));
}

TEST(AddedDrive, GetsAdviceOnAWrongKey) {
  const std::string said = complaint(device("nodes = 3\n"));
  EXPECT_TRUE(said.contains(":11: [[axis]] 1: unknown key 'nodes'; did you mean node?")) << said;
  const std::string unit = complaint(device("max_torque = 0.25\n"));
  EXPECT_TRUE(unit.contains("max_torque_Nm")) << unit;
}

TEST(AddedDrive, RefusesAValueOutOfItsRange) {
  EXPECT_TRUE(complaint(device("node = 16\n")).contains("node must lie between 1 and 15"));
}

TEST(AddedDrive, IsCheckedWithTheWholeDevice) {
  EXPECT_TRUE(complaint(device("")).contains("nothing stops the motor of axis \"motor\""));
  EXPECT_TRUE(complaint(device("encoder = \"absolute\"\n")).contains("encoder must be"));
}

TEST(AddedDrive, PushesAndIsReadOnABus) {
  hal::SimulatedClock clock;
  hal::SimulatedCanNetwork network(clock, {.bit_rate = 1'000'000});
  hal::SimulatedCanBus host(network);
  hal::SimulatedCanBus node(network);
  drivers::RegisteredCanBoard board(host, clock);
  ASSERT_TRUE(board.add(drivers::PivotCan({.node = 3, .max_torque_Nm = 0.125})));
  board.start();

  std::array<drivers::AxisSample, 1> samples;
  const std::array<drivers::AxisCommand, 1> push{{{.torque_Nm = 1.0, .enable = true}}};
  hal::CanFrame heard;
  for (std::uint8_t tick = 0; tick < 5; ++tick) {
    board.read(samples, clock.now_ns());
    board.write(push);
    clock.advance_by(kMs / 2);
    std::array<hal::CanReceived, 4> received;
    ASSERT_TRUE(node.receive(received, hal::kNoWait));
    heard = received[0].frame;
    hal::CanFrame answer{.id = drivers::pivot::answer_id(3), .length = 4};
    answer.data[0] = std::byte{tick};
    ASSERT_TRUE(node.send(std::span(&answer, 1)));
    clock.advance_by(kMs / 2);
  }
  board.read(samples, clock.now_ns());
  EXPECT_EQ(samples[0].status, drivers::kDeviceOk);
  EXPECT_NEAR(samples[0].position_rad, 4.0 * 2.0 * 3.14159265358979 / 8192.0, 1e-12);
  EXPECT_EQ(heard.id, 0x303U);
  EXPECT_EQ(heard.data[0], std::byte{125});  // the limit, 0.125 N m

  clock.advance_by(10 * kMs);
  board.read(samples, clock.now_ns());
  EXPECT_NE(samples[0].status & drivers::kDeviceLost, 0U);
  EXPECT_TRUE(board.trouble(0));
}

}  // namespace
}  // namespace tactus
