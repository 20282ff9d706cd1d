// Hats with a CAN controller on SPI. The texts of `ip` have the form that iproute2 prints for them.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "tests/unit/host_tools/doctor/recorded_machine.h"

namespace tactus::host {
namespace {

constexpr const char* kIpLink = "tactus/ip_link_can0.json";
constexpr const char* kSpiClock = "sys/class/net/can0/device/of_node/spi-max-frequency";

// A Raspberry Pi with an MCP2518FD at 40 MHz, at 1 and 5 Mbit/s, and SPI at 20 MHz.
class DoctorOfHats : public ::testing::Test {
 protected:
  DoctorOfHats() {
    board_.write("proc/device-tree/model", "Raspberry Pi 4 Model B Rev 1.5");
    board_.write("sys/class/net/can0/mtu", "72\n");
    board_.write(kIpLink,
                 R"([{"ifname":"can0","linkinfo":{"info_kind":"can","info_data":)"
                 R"({"ctrlmode":["FD"],"state":"ERROR-ACTIVE","bittiming":{"bitrate":1000000},)"
                 R"("bittiming_const":{"name":"mcp251xfd","brp_inc":1},)"
                 R"("data_bittiming":{"bitrate":5000000},"clock":40000000}}}])");
    board_.write(kSpiClock, std::string_view("\x01\x31\x2d\x00", 4));
    board_.write("tactus/interrupt_delays", "can0 0 1\n");
  }

  RecordedMachine board_;
};

TEST_F(DoctorOfHats, AHatThatIsSetUpWellIsWell) {
  for (const char* check : {"interrupts of can0", "clock of can0", "SPI of can0"}) {
    EXPECT_EQ(board_.finding(check).state, FindingState::well) << check;
  }
  EXPECT_EQ(board_.finding("clock of can0").found, "40 MHz, 8 a data bit");
  EXPECT_EQ(board_.finding("SPI of can0").found, "up to 20 MHz");
}

TEST_F(DoctorOfHats, AnInterruptThatIsDelayedForMostOfATickIsToBeMended) {
  board_.write("tactus/interrupt_delays", "can0 512 16\n");
  const Finding finding = board_.finding("interrupts of can0");
  EXPECT_EQ(finding.state, FindingState::mend);
  EXPECT_EQ(finding.found, "a drive's answer waits for up to 512 us of a tick of 1000 us");
  EXPECT_TRUE(finding.remedy.contains("ethtool -C can0 rx-usecs-irq 0 rx-frames-irq 1"))
      << finding.remedy;
  Needs slow = needs_of_any_device();
  slow.rate_hz = 100.0;
  EXPECT_EQ(board_.finding("interrupts of can0", slow).state, FindingState::well);
}

TEST_F(DoctorOfHats, AnInterruptForEachFrameIsNeverLate) {
  board_.write("tactus/interrupt_delays", "can0 512 1\n");
  EXPECT_EQ(board_.finding("interrupts of can0").found, "one a frame");
}

TEST_F(DoctorOfHats, AnInterfaceWithoutAnInterruptToSetHasNoSuchLine) {
  board_.write("tactus/interrupt_delays", "can1 0 1\n");
  for (const Finding& finding : board_.examine()) {
    EXPECT_FALSE(finding.check.starts_with("interrupts")) << finding.found;
  }
}

TEST_F(DoctorOfHats, AControllerOfHalfTheClockSamplesDataBitsCoarsely) {
  board_.change(kIpLink, "40000000", "20000000");
  const Finding finding = board_.finding("clock of can0");
  EXPECT_EQ(finding.state, FindingState::advice);
  EXPECT_TRUE(finding.found.starts_with("20 MHz, 4 a data bit")) << finding.found;
  EXPECT_TRUE(finding.found.contains("40 MHz")) << finding.found;
}

TEST_F(DoctorOfHats, ASlowSpiIsToBeRaisedInTheOverlay) {
  board_.write(kSpiClock, std::string_view("\x00\x4c\x4b\x40", 4));
  const Finding finding = board_.finding("SPI of can0");
  EXPECT_EQ(finding.state, FindingState::advice);
  EXPECT_TRUE(finding.found.starts_with("up to 5 MHz")) << finding.found;
  EXPECT_TRUE(finding.remedy.contains("speed=20000000")) << finding.remedy;
  board_.write("proc/device-tree/model", "Some other board");
  EXPECT_TRUE(board_.finding("SPI of can0").remedy.contains("device tree"));
}

TEST_F(DoctorOfHats, AnMcp2515IsSaidToLoseFrames) {
  board_.change(kIpLink, "mcp251xfd", "mcp251x");
  EXPECT_EQ(board_.finding("controller of can0").state, FindingState::advice);
}

// Its last byte is a blank, which a text would lose.
TEST_F(DoctorOfHats, ANumberOfTheDeviceTreeIsReadAsBytes) {
  board_.write(kSpiClock, std::string_view("\x00\xbe\xbc\x20", 4));
  EXPECT_EQ(board_.finding("SPI of can0").found, "up to 12.5 MHz");
  board_.write(kSpiClock, "\x01");
  for (const Finding& finding : board_.examine()) {
    EXPECT_FALSE(finding.check.starts_with("SPI")) << finding.found;
  }
}

}  // namespace
}  // namespace tactus::host
