// SocketCAN in the emulated machine: the contract on a virtual interface, with and without CAN FD,
// and on two real SJA1000 controllers joined by a wire; then every error that the interface
// documents.
#include "hal/linux/can_bus.h"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "hal/linux/clock.h"
#include "tests/unit/hal/can_bus_contract.h"

namespace tactus::hal {
namespace {

void shell(const std::string& command) {
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
}

template <int kMtu>
struct VirtualCanRig {
  VirtualCanRig() {
    shell("ip link add dev vcan7 type vcan && ip link set vcan7 mtu " + std::to_string(kMtu) +
          " up");
    EXPECT_TRUE(left_node.open("vcan7"));
    EXPECT_TRUE(right_node.open("vcan7"));
  }
  VirtualCanRig(const VirtualCanRig&) = delete;
  VirtualCanRig& operator=(const VirtualCanRig&) = delete;
  ~VirtualCanRig() { (void)std::system("ip link del vcan7 2>/dev/null"); }

  CanBus& left() { return left_node; }
  CanBus& right() { return right_node; }
  Clock& clock() { return board_clock; }
  static void set_link_up(bool up) {
    shell(std::string("ip link set vcan7 ") + (up ? "up" : "down"));
  }

  LinuxClock board_clock;
  LinuxCanBus left_node;
  LinuxCanBus right_node;
};

struct ControllerRig {
  ControllerRig() {
    for (const std::string name : {"can0", "can1"}) {
      shell("ip link set " + name + " down");
      shell("ip link set " + name + " type can bitrate 1000000");
      shell("ip link set " + name + " txqueuelen 32 up");
    }
    EXPECT_TRUE(left_node.open("can0"));
    EXPECT_TRUE(right_node.open("can1"));
  }
  CanBus& left() { return left_node; }
  CanBus& right() { return right_node; }
  Clock& clock() { return board_clock; }
  static void set_link_up(bool up) {
    shell(std::string("ip link set can0 ") + (up ? "up" : "down"));
  }

  LinuxClock board_clock;
  LinuxCanBus left_node;
  LinuxCanBus right_node;
};

using LinuxRigs = ::testing::Types<VirtualCanRig<72>, VirtualCanRig<16>, ControllerRig>;
INSTANTIATE_TYPED_TEST_SUITE_P(Linux, CanBusContract, LinuxRigs);

class VirtualCan : public ::testing::Test {
 protected:
  TimeNs soon() { return rig.clock().now_ns() + 50'000'000; }

  VirtualCanRig<72> rig;
  std::array<CanReceived, 8> some;
};

TEST_F(VirtualCan, OpeningWhatIsNotThereSaysSo) {
  LinuxCanBus bus;
  EXPECT_EQ(code_of(bus.open("vcan99")), ErrorCode::not_found);
  EXPECT_EQ(code_of(bus.open("lo")), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(bus.open("")), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(bus.open("a_name_that_is_too_long")), ErrorCode::invalid_argument);
}

TEST_F(VirtualCan, BusThatIsNotOpenIsDisconnected) {
  LinuxCanBus bus;
  EXPECT_EQ(code_of(bus.receive(some, kNoWait)), ErrorCode::disconnected);
  EXPECT_EQ(code_of(bus.send(can_frame(1, {1}))), ErrorCode::disconnected);
}

TEST_F(VirtualCan, DeletedInterfaceIsDisconnectedAndCanBeOpenedAgain) {
  shell("ip link del vcan7");
  EXPECT_EQ(code_of(rig.left().receive(some, soon())), ErrorCode::disconnected);
  EXPECT_EQ(code_of(rig.left().send(can_frame(1, {1}))), ErrorCode::disconnected);
  EXPECT_EQ(code_of(rig.left().restart()), ErrorCode::disconnected);
  shell("ip link add dev vcan7 type vcan && ip link set vcan7 mtu 72 up");
  ASSERT_TRUE(rig.left_node.open("vcan7"));
  EXPECT_TRUE(rig.left().send(can_frame(1, {1})));
}

TEST_F(VirtualCan, InterfaceThatIsDownAtOpeningIsNoError) {
  VirtualCanRig<72>::set_link_up(false);
  LinuxCanBus bus;
  ASSERT_TRUE(bus.open("vcan7"));
  EXPECT_EQ(bus.status().state, CanState::stopped);
  EXPECT_EQ(code_of(bus.receive(some, soon())), ErrorCode::link_down);
}

TEST_F(VirtualCan, UnreadSocketCountsWhatItLost) {
  for (int i = 0; i < 20'000; ++i) {
    ASSERT_TRUE(rig.left().send(can_frame(1, {1, 2, 3, 4, 5, 6, 7, 8})));
  }
  while (rig.right().receive(some, kNoWait)) {
  }
  ASSERT_TRUE(rig.left().send(can_frame(2, {})));
  ASSERT_EQ(rig.right().receive(some, soon()), 1U);
  const CanCounters counters = rig.right().counters();
  EXPECT_GT(counters.receive_dropped, 0U);
  EXPECT_EQ(counters.received + counters.receive_dropped, 20'001U);
}

// The kernel hands an error frame that one socket writes to a virtual interface to the others, as
// if its controller had reported it.
class InjectedReports : public VirtualCan {
 public:
  InjectedReports(const InjectedReports&) = delete;
  InjectedReports& operator=(const InjectedReports&) = delete;

 protected:
  InjectedReports() : socket_(socket(PF_CAN, SOCK_RAW, CAN_RAW)) {
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex("vcan7"));
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  }
  ~InjectedReports() override { close(socket_); }

  void inject(std::uint32_t classes, std::uint8_t controller = 0) const {
    KernelFrame frame{};
    frame.can_id = CAN_ERR_FLAG | classes;
    frame.len = kErrorFrame_bytes;
    frame.data[1] = controller;
    frame.data[6] = 130;
    ASSERT_EQ(write(socket_, &frame, sizeof(frame)), static_cast<ssize_t>(sizeof(frame)));
  }

 private:
  using KernelFrame = struct ::can_frame;
  static constexpr std::uint8_t kErrorFrame_bytes = 8;
  int socket_;
};

TEST_F(InjectedReports, BusOffIsKnownWithoutAskingAndEndsSending) {
  inject(kCanBusOff);
  EXPECT_EQ(code_of(rig.left().receive(some, soon())), ErrorCode::timeout);
  EXPECT_EQ(rig.left().status().state, CanState::bus_off);
  EXPECT_EQ(code_of(rig.left().send(can_frame(1, {1}))), ErrorCode::bus_off);
  inject(kCanRestarted);
  EXPECT_EQ(code_of(rig.left().receive(some, soon())), ErrorCode::timeout);
  EXPECT_EQ(rig.left().status().state, CanState::error_active);
  EXPECT_TRUE(rig.left().send(can_frame(1, {1})));
}

TEST_F(InjectedReports, ReportsComeToWhoAskedForTheirClass) {
  ASSERT_TRUE(rig.left().set_error_classes(kCanController | kCanErrorCounters));
  inject(kCanController | kCanErrorCounters, kCanTransmitPassive);
  ASSERT_EQ(rig.left().receive(some, soon()), 1U);
  EXPECT_EQ(some[0].kind, CanReceived::Kind::error);
  EXPECT_EQ(some[0].error.controller, kCanTransmitPassive);
  EXPECT_EQ(rig.left().status().state, CanState::error_passive);
  EXPECT_EQ(rig.left().status().transmit_errors, 130);
  EXPECT_EQ(rig.left().counters().error_reports, 1U);
  inject(kCanNoAcknowledge);
  EXPECT_EQ(code_of(rig.left().receive(some, soon())), ErrorCode::timeout);
}

TEST(CanController, RestartThatTheControllerDoesItselfIsNotSupported) {
  ControllerRig rig;
  shell(
      "ip link set can0 down && ip link set can0 type can bitrate 1000000 restart-ms 100 && "
      "ip link set can0 up");
  EXPECT_EQ(code_of(rig.left().restart()), ErrorCode::not_supported);
  shell("ip link set can0 down && ip link set can0 type can bitrate 1000000 restart-ms 0");
}

TEST(CanController, ClassicControllerRefusesFd) {
  ControllerRig rig;
  EXPECT_FALSE(rig.left().fd_enabled());
  EXPECT_EQ(code_of(rig.left().send(CanFrame{.id = 1, .fd = true, .length = 12})),
            ErrorCode::not_supported);
}

TEST(CanController, FullQueueIsCounted) {
  ControllerRig rig;
  std::array<CanFrame, 64> many;
  many.fill(can_frame(1, {1, 2, 3, 4, 5, 6, 7, 8}));
  // The priority is above that of the controller's interrupt thread, which empties the queue.
  const sched_param above{.sched_priority = 80};
  ASSERT_EQ(sched_setscheduler(0, SCHED_FIFO, &above), 0);
  std::size_t sent = 0;
  for (int i = 0; i < 10; ++i) {
    sent += rig.left().send(many).value_or(0);
  }
  const sched_param ordinary{};
  ASSERT_EQ(sched_setscheduler(0, SCHED_OTHER, &ordinary), 0);
  EXPECT_LT(sent, 640U);
  EXPECT_EQ(rig.left().counters().send_refused, 640U - sent);
}

}  // namespace
}  // namespace tactus::hal
