// Devices that baking refuses because a joint could not know where it is.
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <variant>

#include "tests/unit/host_tools/bake/device/device_texts.h"

namespace tactus::host {
namespace {

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
                  "reference = \"absolute\"\nmotor_ratio = 1\nencoder_ratio = " + ratio + "\n");
  };
  expect_bakes(with_ratio("1"));
  expect_bakes(with_ratio("3.79"));
  expect_words(with_ratio("3.81"), {"\"absolute\" is ambiguous", "encoder_ratio 3.81"});
  expect_words(with_ratio("12"),
               {"0.524 rad", "encoder_ratio 12", "travel of 1.571 rad", "(-0.785 to 0.785)",
                "reference = \"known_pose\"", "absolute encoder at the joint"});
  expect_bakes(paddle("encoder = \"absolute\"\n",
                      "reference = \"absolute\"\nmotor_ratio = 1\nencoder_ratio = 12\n"));
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
           joint("paddle", "servo",
                 "reference = \"absolute\"\nmotor_ratio = 1\nencoder_ratio = " + ratio + "\n");
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
  const auto& line = std::get<drivers::HaplyConnection>(board.config().connections[0].line);
  EXPECT_EQ(line.haply.axis[0].home_rad, 2.5);
  EXPECT_EQ(line.haply.axis[1].home_rad, 2.5);
}

}  // namespace
}  // namespace tactus::host
