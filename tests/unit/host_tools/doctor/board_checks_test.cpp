#include <gtest/gtest.h>

#include <string>

#include "host_tools/bake/device/device_bake.h"
#include "tests/support/paths.h"
#include "tests/unit/host_tools/doctor/recorded_machine.h"

namespace tactus::host {
namespace {

constexpr const char* kLink = "tactus/ip_link_can0.json";

void expect_board_to_mend(const Finding& finding, const std::string& command) {
  EXPECT_EQ(finding.state, FindingState::mend) << finding.found;
  EXPECT_TRUE(finding.remedy.contains(command)) << finding.remedy;
}

Needs needs_of_example(const std::string& name) {
  return needs_of(
      bake_device(testing::in_repository("host_tools/examples/devices/" + name + ".toml"))
          .config());
}

TEST(DoctorOfDevices, TheExamplesNeedWhatTheirFilesName) {
  const Needs moteus = needs_of_example("moteus_arm");
  ASSERT_EQ(moteus.can.size(), 1U);
  EXPECT_EQ(moteus.can[0].interface, "can0");
  EXPECT_TRUE(moteus.can[0].fd);
  EXPECT_FALSE(moteus.falcon || moteus.anything);
  EXPECT_FALSE(needs_of_example("odrive_arm").can[0].fd);
  EXPECT_TRUE(needs_of_example("falcon").falcon);
  const Needs hapkit = needs_of_example("hapkit");
  ASSERT_EQ(hapkit.gpio.size(), 1U);
  EXPECT_NE(hapkit.gpio[0].chip, "");
}

TEST(DoctorOfDevices, EachMotorTellsWhatStopsItWhenTheHostDies) {
  const RecordedMachine board;
  const Finding proven = board.finding("motor servo 1", needs_of_example("moteus_arm"));
  EXPECT_EQ(proven.state, FindingState::well);
  EXPECT_EQ(proven.found, "its drive's watchdog of 20 ms stops it, proven at each bring-up");
  const Finding fed = board.finding("motor drive 0", needs_of_example("odrive_arm"));
  EXPECT_EQ(fed.state, FindingState::advice);
  EXPECT_TRUE(fed.found.contains("any frame to its node feeds it")) << fed.found;
  const Finding nothing = board.finding("motor top", needs_of_example("falcon"));
  EXPECT_EQ(nothing.state, FindingState::advice);
  EXPECT_TRUE(nothing.found.contains("NOTHING stops it")) << nothing.found;
  const Finding heard = board.finding("motor drive 1", needs_of_example("cia402_arm"));
  EXPECT_EQ(heard.state, FindingState::well);
  EXPECT_EQ(heard.found, "its drive's watchdog of 20 ms stops it, proven at each bring-up");
  const Finding circuit = board.finding("motor motor", needs_of_example("hapkit"));
  EXPECT_TRUE(circuit.found.contains("heartbeat line")) << circuit.found;
  EXPECT_TRUE(circuit.remedy.contains("kill -STOP")) << circuit.remedy;
}

TEST(DoctorOfDevices, AWatchdogThatIsTrustedInPlaceOfProvenIsSaidToBe) {
  const RecordedMachine board;
  Needs needs = needs_of_example("moteus_arm");
  needs.motors[1].is_accepted = true;
  const Finding finding = board.finding("motor servo 2", needs);
  EXPECT_EQ(finding.state, FindingState::advice);
  EXPECT_TRUE(finding.found.contains("without proof")) << finding.found;
}

TEST(DoctorOfDevices, ACanInterfaceThatIsUpTellsItsRate) {
  const RecordedMachine board;
  EXPECT_EQ(board.finding("CAN can0").found, "up, 1000 kbit/s, ERROR-ACTIVE");
}

TEST(DoctorOfDevices, ACanInterfaceThatIsDownIsToBeBroughtUp) {
  const RecordedMachine board;
  board.write("sys/class/net/can0/flags", "0x40080\n");
  expect_board_to_mend(board.finding("CAN can0"),
                       "sudo ip link set can0 up type can bitrate 1000000");
}

TEST(DoctorOfDevices, ASilentBusIsSaidToBe) {
  const RecordedMachine board;
  board.change(kLink, "ERROR-ACTIVE", "BUS-OFF");
  const Finding finding = board.finding("CAN can0");
  expect_board_to_mend(finding, "sudo ip link set can0 down");
  EXPECT_TRUE(finding.found.contains("check termination")) << finding.found;
}

TEST(DoctorOfDevices, ADriveWithCanFdNeedsAnInterfaceWithIt) {
  const RecordedMachine board;
  const Needs moteus = needs_of_example("moteus_arm");
  expect_board_to_mend(board.finding("CAN can0", moteus), "dbitrate 5000000");
  board.write("sys/class/net/can0/mtu", "72\n");
  board.change(kLink, R"("clock")", R"("data_bittiming":{"bitrate":5000000},"clock")");
  EXPECT_EQ(board.finding("CAN can0", moteus).found,
            "up, 1000 kbit/s, data 5000 kbit/s, ERROR-ACTIVE, 87 % busy");
}

TEST(DoctorOfDevices, ABusTellsHowBusyTheFramesOfTheDeviceKeepIt) {
  const RecordedMachine board;
  Needs needs{.can = {{.interface = "can0", .set_up = "bitrate 1000000", .bitrate = 1'000'000}}};
  needs.can[0].load = 0.42;
  EXPECT_EQ(board.finding("CAN can0", needs).found, "up, 1000 kbit/s, ERROR-ACTIVE, 42 % busy");
  EXPECT_GT(needs_of_example("odrive_arm").can[0].load, 0.1);
}

TEST(DoctorOfDevices, ABusWithAnotherRateThanTheDevicesFileIsToBeSetAnew) {
  const RecordedMachine board;
  board.change(kLink, "1000000", "500000");
  const Needs needs{.can = {{.interface = "can0", .set_up = "bitrate 250000", .bitrate = 250'000}}};
  const Finding finding = board.finding("CAN can0", needs);
  expect_board_to_mend(finding, "sudo ip link set can0 up type can bitrate 250000");
  EXPECT_TRUE(finding.found.contains("500 kbit/s")) << finding.found;
  board.change(kLink, "500000", "250000");
  EXPECT_EQ(board.finding("CAN can0", needs).state, FindingState::well) << "slow by choice";
}

TEST(DoctorOfDevices, ABusWithoutIpOrWithStrangeWordsOfItIsNotKnown) {
  const RecordedMachine board;
  for (const char* text : {"", "[]", "{}", "[1]", "[{\"linkinfo\":3}]x", "\xff",
                           R"([{"linkinfo":{"info_kind":4}}])"}) {
    board.write(kLink, text);
    const Finding finding = board.finding("CAN can0");
    EXPECT_EQ(finding.state, FindingState::not_looked) << text;
    EXPECT_TRUE(finding.remedy.ends_with("install iproute2")) << finding.remedy;
  }
}

TEST(DoctorOfDevices, AVirtualBusNeedsNoRateAndASlowOneIsAdvisedAgainst) {
  const RecordedMachine board;
  board.change(kLink, "1000000", "250000");
  EXPECT_EQ(board.finding("CAN can0").state, FindingState::advice);
  board.write(kLink, R"([{"ifname":"can0","linkinfo":{"info_kind":"vcan"}}])");
  EXPECT_EQ(board.finding("CAN can0").found, "up, virtual");
}

TEST(DoctorOfDevices, AnInterfaceThatIsMissingOrNoCanIsToBeMended) {
  const RecordedMachine board;
  const Needs needs{.can = {{.interface = "can1", .fd = false, .set_up = ""},
                            {.interface = "lo", .fd = false, .set_up = ""}}};
  EXPECT_EQ(board.finding("CAN can1", needs).found, "no such interface");
  EXPECT_EQ(board.finding("CAN lo", needs).found, "is no CAN interface");
}

TEST(DoctorOfDevices, ARaspberryPiWithoutItsHatOrPwmNeedsAnOverlay) {
  const RecordedMachine board;
  board.write("proc/device-tree/model", "Raspberry Pi 5 Model B Rev 1.0");
  const Needs needs{
      .can = {{.interface = "can1", .set_up = ""}},
      .gpio = {{.chip = "/dev/gpiochip0", .pwm_folder = "/sys/class/pwm/pwmchip0", .counter = ""}}};
  expect_board_to_mend(board.finding("CAN can1", needs), "dtoverlay=mcp251xfd,spi0-0,");
  expect_board_to_mend(board.finding("PWM", needs), "dtoverlay=pwm-2chan");
}

TEST(DoctorOfDevices, AFalconThatMayNotBeUsedNeedsTheRules) {
  const RecordedMachine board;
  board.change("tactus/access", "w /dev/bus/usb/001/005", "- /dev/bus/usb/001/005");
  expect_board_to_mend(board.finding("Falcon"), "udevadm trigger");
}

TEST(DoctorOfDevices, AFalconIsMissedOnlyByADeviceThatIsOne) {
  const RecordedMachine board;
  board.remove("sys/bus/usb/devices/1-1.2");
  EXPECT_EQ(board.finding("Falcon").state, FindingState::well);
  expect_board_to_mend(board.finding("Falcon", needs_of_example("falcon")), "lsusb -d 0403:cb48");
  for (const Finding& finding : board.examine(needs_of_example("odrive_arm"))) {
    EXPECT_NE(finding.check, "Falcon");
  }
}

TEST(DoctorOfDevices, AGpioChipIsFoundByItsLabelOrItsPath) {
  const RecordedMachine board;
  board.write("tactus/access",
              "w /dev/gpiochip0\nw /sys/class/pwm/pwmchip0/export\nw "
              "/sys/bus/counter/devices/counter0/count0/enable\n");
  Needs needs{.gpio = {{.chip = "pinctrl-bcm2711",
                        .pwm_folder = "/sys/class/pwm/pwmchip0",
                        .counter = "counter0"}}};
  EXPECT_EQ(board.finding("GPIO gpiochip0", needs).found, "gpiochip0 (pinctrl-bcm2711)");
  EXPECT_EQ(board.finding("PWM", needs).state, FindingState::well);
  EXPECT_EQ(board.finding("counter counter0", needs).state, FindingState::well);
  needs.gpio[0].chip = "/dev/gpiochip7";
  expect_board_to_mend(board.finding("GPIO /dev/gpiochip7", needs), "gpiodetect");
  needs.gpio[0].chip = "other";
  expect_board_to_mend(board.finding("GPIO other", needs), "gpiodetect");
}

TEST(DoctorOfDevices, AGpioChipThatMayNotBeOpenedMightBeTheOne) {
  const RecordedMachine board;
  board.write("tactus/gpio_chips", "");
  const Needs needs{.gpio = {{.chip = "pinctrl-bcm2711", .pwm_folder = "", .counter = ""}}};
  expect_board_to_mend(board.finding("GPIO pinctrl-bcm2711", needs), "udevadm");
}

TEST(DoctorOfDevices, ASerialPortMustBeThereAndReadable) {
  const RecordedMachine board;
  const Needs needs{.serial_ports = {"/dev/ttyACM0"}};
  expect_board_to_mend(board.finding("serial port", needs), "ls /dev/ttyACM*");
  board.write("tactus/access", "- /dev/ttyACM0\n");
  expect_board_to_mend(board.finding("serial port", needs), "cmake --install");
  board.write("tactus/access", "w /dev/ttyACM0\n");
  EXPECT_EQ(board.finding("serial port", needs).state, FindingState::well);
}

}  // namespace
}  // namespace tactus::host
