// Devices that baking refuses, and that the reader of an image made by hand refuses too.
#include <gtest/gtest.h>

#include <cstring>
#include <numbers>
#include <string>

#include "firmware/device_file/bus_load.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/input_error.h"
#include "rendering/scene/image_format.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

std::string replaced(std::string text, const std::string& old_text, const std::string& new_text) {
  const std::size_t at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  return text.replace(at, old_text.size(), new_text);
}

std::string axis(const std::string& name, const std::string& driver, const std::string& keys,
                 const std::string& connection = "bus") {
  return "[[axis]]\nname = \"" + name + "\"\ndriver = \"" + driver + "\"\nconnection = \"" +
         connection + "\"\n" + keys;
}

std::string joint(const std::string& name, const std::string& motor, const std::string& keys) {
  return "[[joint]]\nname = \"" + name + "\"\nmotor = \"" + motor + "\"\n" + keys;
}

std::string device(const std::string& mechanism, double rate_hz) {
  return "[mechanism]\nkind = \"" + mechanism +
         "\"\n[controller]\nrate_hz = " + std::to_string(rate_hz) + "\n";
}

constexpr const char* kBus =
    "[[connection]]\nname = \"bus\"\nkind = \"can\"\ninterface = \"can0\"\n";
constexpr const char* kKnownPose = "reference = \"known_pose\"\n";

const std::string kODrive = "max_torque_Nm = 0.2\n";

// A paddle of +-45 degrees on one ODrive, with these keys at the axis and the joint.
std::string paddle(const std::string& axis_keys, const std::string& joint_keys,
                   double rate_hz = 1000.0) {
  return device("hapkit", rate_hz) + kBus + axis("drive", "odrive_can", kODrive + axis_keys) +
         joint("paddle", "drive", joint_keys);
}

// Three joints, each on an axis with these words.
std::string arm(const std::string& first, const std::string& second, const std::string& third,
                double rate_hz = 500.0) {
  return device("woodenhaptics", rate_hz) + kBus + first + second + third +
         joint("azimuth", "a", kKnownPose) + joint("upper arm", "b", kKnownPose) +
         joint("forearm", "c", kKnownPose);
}

std::string odrive(const std::string& name, int node) {
  return axis(name, "odrive_can", kODrive + "node_id = " + std::to_string(node) + "\n");
}

std::string cia402(const std::string& name, int node, bool leads, const std::string& period_s) {
  return axis(name, "cia402_can",
              "max_torque_Nm = 0.2\nnode = " + std::to_string(node) +
                  "\nleads_bus = " + (leads ? "true" : "false") + "\nperiod_s = " + period_s +
                  "\nlost_after_s = 0.01\n");
}

constexpr const char* kGpio =
    "[[connection]]\nname = \"board\"\nkind = \"gpio\"\nchip = \"header\"\n"
    "pwm_folder = \"/sys/class/pwm/pwmchip0\"\n";

const std::string kBridge =
    "encoder_a = \"0\"\nencoder_b = \"1\"\ndirection = \"2\"\ncounts_per_turn = 1000\n"
    "max_speed_rad_per_s = 200\nfull_duty_torque_Nm = 0.03\nmax_torque_Nm = 0.03\n";

std::string bridge(const std::string& axis_keys, const std::string& joint_keys = kKnownPose) {
  return device("hapkit", 1000.0) + kGpio +
         axis("motor", "gpio_axis", kBridge + axis_keys, "board") +
         joint("paddle", "motor", joint_keys);
}

std::string haply(const std::string& connection_keys, const std::string& joint_keys,
                  int second_number = 1) {
  return device("haply_pantograph", 1000.0) +
         "[[connection]]\nname = \"usb\"\nkind = \"haply_serial\"\nport = \"/dev/ttyACM0\"\n" +
         connection_keys + axis("m1", "haply_serial", "number = 0\n", "usb") +
         axis("m2", "haply_serial", "number = " + std::to_string(second_number) + "\n", "usb") +
         joint("left", "m1", joint_keys) + joint("right", "m2", joint_keys);
}

class DeviceRefusals : public ::testing::Test {
 protected:
  // Baking's words about the file, or that it bakes.
  std::string complaint(const std::string& text) const {
    const auto file = folder.write("device.toml", text);
    try {
      (void)bake_device(file);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(file.string().size());
    }
    return "bakes";
  }
  void expect_words(const std::string& text, std::initializer_list<const char*> words) const {
    const std::string said = complaint(text);
    for (const char* word : words) {
      EXPECT_TRUE(said.contains(word)) << "'" << word << "' is not in: " << said;
    }
  }
  void expect_bakes(const std::string& text) const { EXPECT_EQ(complaint(text), "bakes"); }

  testing::TemporaryFolder folder;
};

TEST_F(DeviceRefusals, AJointSaysHowItLearnsWhereItIs) {
  EXPECT_EQ(complaint(bridge("heartbeat = \"4\"\n", "")),
            ":22: [[joint]] 1: reference is missing, and has no default: it says how the joint "
            "learns where it is after power-up, \"absolute\", \"board\", \"known_pose\", \"index\" "
            "or \"hard_stop\"; a gpio_axis counts from where it wakes up: \"known_pose\", "
            "\"hard_stop\", or with an encoder_index \"index\"");
  expect_words(paddle("", ""), {"reference is missing", "declared at the axis", "absolute_turn"});
  expect_words(haply("unproven_watchdog = true\n", ""), {"reference is missing", "a Haply board"});
}

TEST_F(DeviceRefusals, AbsoluteIsRefusedWhereTheEncoderIsIncremental) {
  const std::string absolute = "reference = \"absolute\"\n";
  expect_words(bridge("heartbeat = \"4\"\n", absolute),
               {"reference does not fit the encoder of axis \"motor\"", "\"known_pose\""});
  expect_words(haply("unproven_watchdog = true\n", absolute), {"reference does not fit"});
  expect_words(paddle("", absolute), {"reference does not fit the encoder of axis \"drive\"",
                                      "counts from where it wakes", "encoder = \"absolute_turn\""});
  expect_words(paddle("", "reference = \"board\"\n"), {"reference does not fit"});
  expect_words(paddle("", "reference = \"index\"\n"), {"reference does not fit"});
  expect_words(bridge("heartbeat = \"4\"\n", "reference = \"index\"\n"), {"encoder_index"});
  expect_bakes(bridge("heartbeat = \"4\"\nencoder_index = \"5\"\n", "reference = \"index\"\n"));
  expect_words(bridge("heartbeat = \"4\"\nencoder = \"absolute\"\n"),
               {"encoder must be \"incremental\" with this driver"});
}

// The travel is pi/2 and the margin a twentieth of a turn: a turn of 2 pi / ratio suffices up to a
// ratio of (2 pi - pi / 10) / (pi / 2) = 3.8.
TEST_F(DeviceRefusals, AbsoluteIsRefusedWhereATurnOfTheEncoderIsAmbiguous) {
  const auto with_ratio = [](const std::string& ratio) {
    return paddle("encoder = \"absolute_turn\"\nencoder_turn_begins_rad = -3.14159265\n",
                  "reference = \"absolute\"\nencoder_ratio = " + ratio + "\n");
  };
  expect_bakes(with_ratio("1"));
  expect_bakes(with_ratio("3.79"));
  expect_words(with_ratio("3.81"), {"\"absolute\" is ambiguous", "encoder_ratio 3.81"});
  expect_words(with_ratio("12"),
               {"0.524 rad", "encoder_ratio 12", "travel of 1.571 rad", "(-0.785 to 0.785)",
                "reference = \"known_pose\"", "absolute encoder at the joint"});
  expect_bakes(
      paddle("encoder = \"absolute\"\n", "reference = \"absolute\"\nencoder_ratio = 12\n"));
}

TEST_F(DeviceRefusals, AbsoluteIsRefusedWhereTheTurnBeginsWithinTheTravel) {
  const std::string turn = "encoder = \"absolute_turn\"\n";
  expect_words(paddle(turn, "reference = \"absolute\"\n"),
               {"may be a turn off", "reads -0.785 to 0.785 rad", "from 0 to 6.283 rad"});
  expect_bakes(paddle(turn, "reference = \"absolute\"\noffset_rad = -3.1\n"));
  expect_bakes(
      paddle(turn, "reference = \"absolute\"\noffset_rad = 3.1\nencoder_direction = -1\n"));
}

TEST_F(DeviceRefusals, AMoteusKnowsOneTurnOfItsOutputAndBeginsAtMinusHalfATurn) {
  const auto with = [](const std::string& kind, const std::string& ratio) {
    return device("hapkit", 1000.0) + kBus + axis("servo", "moteus_canfd", kind) +
           joint("paddle", "servo", "reference = \"absolute\"\nencoder_ratio = " + ratio + "\n");
  };
  expect_bakes(with("encoder = \"absolute\"\n", "1"));
  expect_words(with("encoder = \"absolute\"\n", "12"), {"is ambiguous"});
  const auto file = folder.write("device.toml", with("encoder = \"absolute\"\n", "1"));
  const LoadedDevice servo = bake_device(file);
  EXPECT_TRUE(std::get<drivers::MoteusConfig>(servo.config().axes[0].drive).absolute_output);
  EXPECT_NEAR(servo.config().joints[0].reference.upper, std::numbers::pi / 4.0, 1e-12);
  EXPECT_NEAR(servo.config().joints[0].reference.lower, -std::numbers::pi / 4.0, 1e-12);
}

TEST_F(DeviceRefusals, AFalconIsReferencedByItsBoardAlone) {
  const auto falcon = [](const std::string& reference) {
    std::string text = device("falcon", 1000.0) +
                       "[[connection]]\nname = \"usb\"\nkind = \"falcon_usb\"\n"
                       "unproven_watchdog = true\n";
    for (const char* number : {"0", "1", "2"}) {
      text += axis(number, "falcon_usb", std::string("number = ") + number + "\n", "usb") +
              joint(std::string("j") + number, number, "reference = \"" + reference + "\"\n");
    }
    return text;
  };
  expect_bakes(falcon("board"));
  expect_words(falcon("absolute"), {"reference does not fit", "write reference = \"board\""});
  expect_words(replaced(falcon("board"), "unproven_watchdog = true\n", ""),
               {"needs a watchdog_line", "unproven_watchdog = true at the connection"});
  expect_words(replaced(falcon("board"), "number = 2", "number = 1"),
               {"number is also that of axis \"1\""});
  expect_words(replaced(falcon("board"), "number = 2", "number = 3"), {"must be 0, 1 or 2"});
}

TEST_F(DeviceRefusals, AVescIsAnEncoderOnlyWhereItReportsItsPositionEachTick) {
  const auto vesc = [](const std::string& keys) {
    return device("hapkit", 1000.0) + kBus +
           axis("vesc", "vesc_can",
                "torque_constant_Nm_per_A = 0.03\nmax_torque_Nm = 0.03\n" + keys) +
           joint("paddle", "vesc", kKnownPose);
  };
  expect_words(vesc("status_period_s = 0.001\n"), {"offers_position = true"});
  expect_words(vesc("offers_position = true\n"),
               {"status_period_s is 0.005 s", "ticks every 0.001 s", "rate_hz = 200 or less"});
  expect_bakes(vesc("offers_position = true\nstatus_period_s = 0.001\n"));
}

TEST_F(DeviceRefusals, TheArmsOfAHaplyBoardStandAtTheirKnownPose) {
  const auto file = folder.write(
      "device.toml",
      haply("unproven_watchdog = true\n", "reference = \"known_pose\"\nreference_rad = 2.5\n"));
  const LoadedDevice board = bake_device(file);
  const auto& line = std::get<firmware::HaplyConnection>(board.config().connections[0].line);
  EXPECT_EQ(line.haply.axis[0].home_rad, 2.5);
  EXPECT_EQ(line.haply.axis[1].home_rad, 2.5);
}

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

TEST(DeviceWords, NumbersAreRoundedAndLoseTheirLastZeros) {
  firmware::Words words;
  words.add(0.5236, 3).add(" ").add(-0.0625, 4).add(" ").add(12.0).add(" ").add(0.9996).add(" ");
  words.add(-0.0001).add(" ").add(146.4, 0).add(" ").add(0x181U, 16U).add(" ").add(1e300);
  EXPECT_EQ(words.view(), "0.524 -0.0625 12 1 0 146 181 more than 1e9");
}

TEST(DeviceWords, WhatDoesNotFitIsLeftOut) {
  firmware::Words words;
  for (int i = 0; i < 100; ++i) {
    words.add("twelve bytes");
  }
  EXPECT_EQ(words.view().size(), 640U);
}

// An image made by hand, or by another version, is held to the same.
TEST_F(DeviceRefusals, AnImageIsHeldToTheSameAsAFile) {
  const auto file = folder.write("device.toml", paddle("", kKnownPose));
  std::vector<std::byte> image = bake_device(file).image();
  const std::string pose = "known_pose";
  const auto at = std::ranges::search(image, pose, [](std::byte b, char c) {
                    return static_cast<char>(b) == c;
                  }).begin();
  ASSERT_NE(at, image.end());
  // The text's length stands before it.
  std::memcpy(&*at, "absolute\0\0", pose.size());
  *(at - 4) = std::byte{8};
  rendering::ImageHeader header;
  std::memcpy(&header, image.data(), sizeof(header));
  header.checksum = rendering::image_checksum(header, std::span(image).subspan(sizeof(header)));
  std::memcpy(image.data(), &header, sizeof(header));
  try {
    (void)LoadedDevice(image, "image");
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).contains("reference does not fit")) << error.what();
  }
}

TEST_F(DeviceRefusals, AnImageOfTheVersionBeforeMustBeBakedAgain) {
  const auto file = folder.write("device.toml", paddle("", kKnownPose));
  std::vector<std::byte> image = bake_device(file).image();
  rendering::ImageHeader header;
  std::memcpy(&header, image.data(), sizeof(header));
  header.version = 1;
  header.checksum =
      rendering::image_checksum(header, std::span<const std::byte>(image).subspan(sizeof(header)));
  std::memcpy(image.data(), &header, sizeof(header));
  try {
    (void)LoadedDevice(image, "image");
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).contains("bake it again")) << error.what();
  }
}

}  // namespace
}  // namespace tactus::host
