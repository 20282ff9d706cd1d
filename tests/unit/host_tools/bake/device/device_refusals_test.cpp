// Devices that baking refuses because their parts do not fit together.
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "firmware/device_file/bus_load.h"
#include "tests/unit/host_tools/bake/device/device_texts.h"

namespace tactus::host {
namespace {

TEST_F(DeviceRefusals, DrivesOfOneBusHaveNumbersOfTheirOwn) {
  expect_words(arm(odrive("a", 0), odrive("b", 0), odrive("c", 1)),
               {"[[axis]] 2: node_id is also that of axis \"a\"", "a number of its own"});
  const auto moteus = [](const std::string& name, const std::string& keys) {
    return axis(name, "moteus_canfd", keys);
  };
  expect_words(arm(moteus("a", "servo_id = 1\n"), moteus("b", "servo_id = 2\n"),
                   moteus("c", "servo_id = 1\n")),
               {"[[axis]] 3: servo_id is also that of axis \"a\""});
  expect_bakes(arm(moteus("a", "servo_id = 1\n"), moteus("b", "servo_id = 2\n"),
                   moteus("c", "servo_id = 1\nprefix = 4\n")));
  expect_words(arm(cia402("a", 1, true, "0.002"), cia402("b", 1, false, "0.002"),
                   cia402("c", 2, false, "0.002")),
               {"[[axis]] 2: node is also that of axis \"a\""});
  const auto vesc = [](const std::string& name, const std::string& keys) {
    return axis(name, "vesc_can", "torque_constant_Nm_per_A = 1\nmax_torque_Nm = 1\n" + keys);
  };
  expect_words(
      arm(vesc("a", "vesc_id = 3\n"), vesc("b", "vesc_id = 3\n"), vesc("c", "vesc_id = 4\n")),
      {"[[axis]] 2: vesc_id is also that of axis \"a\""});
}

// ODrive's node n owns 32 n to 32 n + 31: node 4 has CANopen's SYNC, 0x80, and node 12 the first
// transmit PDO of CANopen's node 1, 0x181.
TEST_F(DeviceRefusals, DrivesOfDifferentMakersDoNotShareIdentifiers) {
  expect_words(arm(cia402("a", 1, true, "0.002"), odrive("b", 4), odrive("c", 24)),
               {"node_id gives it the CAN identifier 0x80 (11 bits)", "axis \"a\" uses too"});
  expect_words(arm(cia402("a", 1, true, "0.002"), odrive("b", 12), odrive("c", 24)),
               {"node_id gives it the CAN identifier 0x181"});
  expect_bakes(arm(cia402("a", 1, true, "0.002"), odrive("b", 30), odrive("c", 24)));
  // A servo 1 answers the host 0 with 0x100: a VESC 0 takes that for a current.
  const auto mixed = [](const std::string& vesc_id) {
    return arm(axis("a", "moteus_canfd", "servo_id = 1\n"), odrive("b", 24),
               axis("c", "vesc_can",
                    "torque_constant_Nm_per_A = 1\nmax_torque_Nm = 1\noffers_position = true\n"
                    "status_period_s = 0.002\nvesc_id = " +
                        vesc_id + "\n"));
  };
  expect_words(mixed("0"), {"vesc_id gives it the CAN identifier 0x100 (29 bits)"});
  expect_bakes(mixed("5"));
}

TEST_F(DeviceRefusals, AMotorAndAnEncoderBelongToOneJoint) {
  std::string text = arm(odrive("a", 0), odrive("b", 1), odrive("c", 2));
  expect_bakes(text);
  text = replaced(text, "motor = \"b\"", "motor = \"a\"");
  expect_words(text, {"[[joint]] 2: motor is also that of joint \"azimuth\"", "one motor"});
  text = replaced(text, "motor = \"a\"\nreference = \"known_pose\"\n[[joint]]\nname = \"forearm",
                  "motor = \"b\"\nencoder = \"a\"\nreference = \"known_pose\"\n[[joint]]\nname = "
                  "\"forearm");
  expect_words(text, {"[[joint]] 2: encoder is also that of joint \"azimuth\"", "one encoder"});
}

TEST_F(DeviceRefusals, NamesAreGivenOnce) {
  const std::string text = arm(odrive("a", 0), odrive("b", 1), odrive("c", 2));
  expect_words(text + odrive("a", 9), {"[[axis]] 4: name is also that of another axis, \"a\""});
  expect_words(replaced(text, "name = \"forearm\"", "name = \"azimuth\""), {"another joint"});
  expect_words(text + kBus, {"[[connection]] 2: name is also that of another connection"});
}

TEST_F(DeviceRefusals, AnInterfaceHasANameThatTheSystemCanHave) {
  const std::string text = arm(odrive("a", 0), odrive("b", 1), odrive("c", 2));
  for (const char* name : {"", "can/0", "can 0", "a234567890123456", "can0:1", "..", "c\\t0"}) {
    expect_words(replaced(text, "\"can0\"", "\"" + std::string(name) + "\""),
                 {"interface must be the name of a network interface", "1 to 15 characters"});
  }
  expect_bakes(replaced(text, "\"can0\"", "\"a23456789012345\""));
  expect_words(replaced(text, "interface = \"can0\"\n", ""), {"interface must be the name"});
  expect_words(replaced(haply("unproven_watchdog = true\n", kKnownPose), "/dev/ttyACM0", "ttyACM0"),
               {"port must be the path of a serial port"});
}

TEST_F(DeviceRefusals, ConnectionsDoNotShareWhatTheyOpen) {
  const std::string two = replaced(arm(odrive("a", 0), odrive("b", 1), odrive("c", 2)), "[[axis]]",
                                   replaced(kBus, "\"bus\"", "\"bus 2\"") + "[[axis]]");
  expect_words(two, {"[[connection]] 2: interface is also that of connection \"bus\""});
}

TEST_F(DeviceRefusals, ALineOfAChipIsUsedOnce) {
  expect_words(bridge("enable = \"2\"\nheartbeat = \"4\"\n"),
               {"[[axis]] 1: enable is line 2, which is also direction"});
  const std::string watched =
      "watchdog_chip = \"header\"\nwatchdog_line = \"1\"\n" + bridge("heartbeat = \"4\"\n");
  expect_words(watched, {"encoder_b is line 1, which is also the device's watchdog_line"});
  expect_bakes(replaced(watched, "watchdog_chip = \"header\"", "watchdog_chip = \"other\""));
  const std::string second = replaced(replaced(kGpio, "\"board\"", "\"board 2\""), "pwmchip0\"",
                                      "pwmchip0\"\npwm_channel = 1");
  const std::string two =
      bridge("heartbeat = \"4\"\n") + second +
      axis("second", "gpio_axis",
           replaced(replaced(replaced(kBridge, "\"0\"", "\"6\""), "\"1\"", "\"7\""), "\"2\"",
                    "\"4\""),
           "board 2");
  expect_words(two, {"[[axis]] 2: direction is line 4, which is also heartbeat of axis \"motor\""});
  expect_bakes(replaced(two, "direction = \"4\"", "direction = \"8\""));
  expect_words(replaced(two, "pwm_channel = 1", "pwm_channel = 0"),
               {"[[connection]] 2: pwm_channel is also that of connection \"board\""});
  expect_words(replaced(two, "connection = \"board 2\"", "connection = \"board\""),
               {"[[axis]] 2: connection is also that of axis \"motor\"", "carries one axis"});
}

TEST_F(DeviceRefusals, SomethingStopsEveryMotorWhenTheHostDies) {
  expect_words(bridge(""), {"[[axis]] 1: needs a heartbeat line", "axis \"motor\"",
                            "keep its torque", "unproven_watchdog = true at the axis"});
  expect_words(bridge("enable = \"3\"\n"), {"needs a heartbeat line"});
  expect_bakes(bridge("heartbeat = \"4\"\n"));
  expect_bakes(bridge("unproven_watchdog = true\n"));
  expect_bakes("watchdog_chip = \"header\"\nwatchdog_line = \"9\"\n" + bridge(""));
  expect_words(haply("", kKnownPose),
               {"[[connection]] 1: needs a watchdog_line", "at the connection"});
  expect_bakes("watchdog_chip = \"header\"\nwatchdog_line = \"9\"\n" + haply("", kKnownPose));
  expect_bakes(device("hapkit", 1000.0) + kBus +
               axis("drive", "cia402_can", "max_torque_Nm = 0.2\n") +
               joint("paddle", "drive", kKnownPose));
  const auto file = folder.write("device.toml", paddle("unproven_watchdog = true\n", kKnownPose));
  EXPECT_TRUE(
      std::get<drivers::ODriveConfig>(bake_device(file).config().axes[0].drive).unproven_watchdog);
}

TEST_F(DeviceRefusals, ADriveIsAsFastAsTheController) {
  expect_words(arm(cia402("a", 1, true, "0.001"), cia402("b", 2, false, "0.001"),
                   cia402("c", 3, false, "0.001"), 2000.0),
               {"[[axis]] 1: period_s is 0.001 s", "ticks every 0.0005 s", "rate_hz = 2000",
                "write period_s = 0.0005", "rate_hz = 1000"});
  expect_words(paddle("", kKnownPose, 2000.0),
               {"estimates come every 0.001 s", "estimates = \"requested\""});
  expect_bakes(paddle("estimates = \"requested\"\n", kKnownPose, 2000.0));
}

// Worst-case lengths by the published formula, 8 n + 44 + floor((34 + 8 n - 1) / 4) and three bits
// of space: 95 bits with four bytes, 135 with eight.
TEST_F(DeviceRefusals, ABusCarriesItsFrames) {
  const auto quiet = [](const std::string& name, int node) {
    return axis(name, "odrive_can",
                kODrive + "poll_period_s = 0\ntorque_period_s = 0\nnode_id = " +
                    std::to_string(node) + "\n");
  };
  const auto file =
      folder.write("device.toml", arm(quiet("a", 0), quiet("b", 1), quiet("c", 2), 1000.0));
  EXPECT_NEAR(firmware::bus_load(bake_device(file).config(), 0),
              3.0 * (1000.0 * 95.0 + 1000.0 * 135.0 + 100.0 * 135.0) / 1e6, 1e-12);
  EXPECT_TRUE(in_words(bake_device(file).config()).contains("bus: the bus is at most 73 % full"));
  const std::string slow =
      replaced(arm(quiet("a", 0), quiet("b", 1), quiet("c", 2), 1000.0), "interface = \"can0\"\n",
               "interface = \"can0\"\nbit_rate = 500000\n");
  expect_words(slow, {"[[connection]] 1: the bus would be 146 % full", "rate_hz = 1000",
                      "bit_rate = 500000", "more than the 90 %"});
  expect_words(replaced(slow, "500000", "5000"), {"bit_rate must lie between"});
  expect_words(replaced(slow, "500000", "1000000\ndata_bit_rate = 9000000"),
               {"data_bit_rate must lie between"});
}

}  // namespace
}  // namespace tactus::host
