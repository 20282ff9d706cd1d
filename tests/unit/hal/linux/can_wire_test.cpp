#include "hal/linux/can_wire.h"

#include <gtest/gtest.h>
#include <linux/can/error.h>

#include <array>
#include <cstring>
#include <utility>

#include "tests/unit/hal/same_frame.h"

namespace tactus::hal {
namespace {

TEST(CanWire, FramesComeBackAsTheyWent) {
  const CanFrame classic{.id = 0x123, .length = 3, .data = {std::byte{1}, std::byte{2}}};
  const CanFrame remote{.id = 0x1ABC'DEF0, .extended = true, .remote = true, .length = 8};
  const CanFrame fast{
      .id = 0x7FF, .fd = true, .bit_rate_switch = true, .length = 64, .data = {std::byte{9}}};
  for (const CanFrame& frame : {classic, remote, fast}) {
    const CanWireFrame wire = to_wire(frame);
    EXPECT_EQ(wire.bytes, frame.fd ? CANFD_MTU : CAN_MTU);
    const CanFrame back = from_wire(wire.frame, frame.fd);
    expect_same(back, frame);
    EXPECT_EQ(back.data, frame.data);
  }
}

TEST(CanWire, AClassicFrameHasNoMoreThanEightBytesWhateverItSays) {
  canfd_frame wire{};
  wire.can_id = 0x123;
  wire.len = 64;
  EXPECT_EQ(from_wire(wire, false).length, 8);
}

// The kernel's linux/can/error.h.
TEST(CanWire, ReportsAreTheKernels) {
  for (const auto& [kernels, ours] :
       {std::pair<std::uint32_t, std::uint32_t>{CAN_ERR_BUSOFF, kCanBusOff},
        {CAN_ERR_CRTL, kCanController},
        {CAN_ERR_ACK, kCanNoAcknowledge},
        {CAN_ERR_RESTARTED, kCanRestarted}}) {
    canfd_frame wire{};
    wire.can_id = CAN_ERR_FLAG | kernels;
    EXPECT_EQ(error_from_wire(wire).classes, ours);
  }
  canfd_frame passive{};
  passive.can_id = CAN_ERR_FLAG | CAN_ERR_CRTL;
  passive.data[1] = CAN_ERR_CRTL_TX_PASSIVE;
  passive.data[6] = 130;
  passive.data[7] = 12;
  const CanErrorReport report = error_from_wire(passive);
  EXPECT_EQ(report.controller, kCanTransmitPassive);
  EXPECT_EQ(report.transmit_errors, 130);
  EXPECT_EQ(report.receive_errors, 12);
}

// The kernel passes this number beside a frame: socket(7), SO_RXQ_OVFL.
TEST(CanWire, TheKernelTellsHowManyFramesItDropped) {
  alignas(cmsghdr) std::array<std::byte, CMSG_SPACE(sizeof(std::uint32_t))> room{};
  msghdr message{};
  message.msg_control = room.data();
  message.msg_controllen = room.size();
  cmsghdr* const item = CMSG_FIRSTHDR(&message);
  item->cmsg_level = SOL_SOCKET;
  item->cmsg_type = SO_RXQ_OVFL;
  item->cmsg_len = CMSG_LEN(sizeof(std::uint32_t));
  constexpr std::uint32_t kDrops = 7;
  std::memcpy(CMSG_DATA(item), &kDrops, sizeof kDrops);
  const CanAncillary told = read_ancillary(message);
  EXPECT_TRUE(told.tells_drops);
  EXPECT_EQ(told.drops, 7U);
  message.msg_controllen = 0;
  EXPECT_FALSE(read_ancillary(message).tells_drops);
}

}  // namespace
}  // namespace tactus::hal
