#include "hal/simulated/can_bus.h"

#include <map>

#include "tests/unit/hal/can_bus_contract.h"

namespace tactus::hal {
namespace {

template <bool kFd, std::uint32_t kBitRate>
struct SimulatedCanRig {
  CanBus& left() { return left_node; }
  CanBus& right() { return right_node; }
  Clock& clock() { return simulated; }
  void set_link_up(bool up) { left_node.set_link_up(up); }

  SimulatedClock simulated;
  SimulatedCanNetwork network{simulated,
                              {.fd = kFd, .bit_rate = kBitRate, .data_bit_rate = 4 * kBitRate}};
  SimulatedCanBus left_node{network};
  SimulatedCanBus right_node{network};
};

using CanRigs = ::testing::Types<SimulatedCanRig<true, 0>, SimulatedCanRig<false, 0>,
                                 SimulatedCanRig<true, 1'000'000>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, CanBusContract, CanRigs);

constexpr TimeNs kCanUs = 1000;

class SimulatedCan : public ::testing::Test {
 protected:
  std::vector<CanReceived> all(SimulatedCanBus& bus) {
    std::vector<CanReceived> received(bus.waiting_to_be_read());
    if (!received.empty()) {
      EXPECT_EQ(bus.receive(received, kNoWait), received.size());
    }
    return received;
  }

  SimulatedClock clock_{0};
  SimulatedCanNetwork instant_{clock_, {.fd = true}};
  SimulatedCanNetwork wire_{clock_, {.fd = true, .bit_rate = 1'000'000}};
};

// A classic frame has 47 bits around its data, 67 with a 29-bit identifier: Bosch CAN 2.0, without
// stuffing.
TEST_F(SimulatedCan, FrameTakesItsBitsTimesTheBitTime) {
  const SimulatedCanNetworkConfig config{
      .fd = true, .bit_rate = 1'000'000, .data_bit_rate = 5'000'000};
  EXPECT_EQ(wire_time_ns({.length = 8}, config), 111 * kCanUs);
  EXPECT_EQ(wire_time_ns({.extended = true, .length = 8}, config), 131 * kCanUs);
  EXPECT_EQ(wire_time_ns({.remote = true, .length = 8}, config), 47 * kCanUs);
  EXPECT_EQ(wire_time_ns({.length = 8}, {.bit_rate = 500'000}), 222 * kCanUs);
  const TimeNs plain = wire_time_ns({.fd = true, .length = 64}, config);
  const TimeNs fast = wire_time_ns({.fd = true, .bit_rate_switch = true, .length = 64}, config);
  EXPECT_GT(plain, 512 * kCanUs);
  EXPECT_LT(fast, plain / 3);
}

// The sizes are those of the Linux kernel (include/linux/can/length.h, 2023): 30 bits around a
// frame with a standard identifier, 49 with an extended one; 5 bits of control field; a CRC field
// of 27 bits up to 16 bytes of data and 32 above, with 6 and 7 fixed stuff bits.
TEST_F(SimulatedCan, FdFrameHasTheFixedStuffBitsOfItsChecksum) {
  const SimulatedCanNetworkConfig config{.fd = true, .bit_rate = 1'000'000};
  EXPECT_EQ(wire_time_ns({.fd = true, .length = 0}, config), (30 + 5 + 27) * kCanUs);
  EXPECT_EQ(wire_time_ns({.fd = true, .length = 16}, config), (30 + 5 + 128 + 27) * kCanUs);
  EXPECT_EQ(wire_time_ns({.fd = true, .length = 20}, config), (30 + 5 + 160 + 32) * kCanUs);
  EXPECT_EQ(wire_time_ns({.extended = true, .fd = true, .length = 64}, config),
            (49 + 5 + 512 + 32) * kCanUs);
}

TEST_F(SimulatedCan, ReceiverIsWokenWhenTheFrameEnds) {
  SimulatedCanBus left(wire_);
  SimulatedCanBus right(wire_);
  ASSERT_TRUE(left.send(can_frame(1, {1, 2, 3, 4, 5, 6, 7, 8})));
  std::array<CanReceived, 1> one;
  EXPECT_EQ(code_of(right.receive(one, 110 * kCanUs)), ErrorCode::timeout);
  EXPECT_EQ(right.receive(one, 1000 * kCanUs), 1U);
  EXPECT_EQ(clock_.now_ns(), 111 * kCanUs);
  EXPECT_EQ(one[0].time_ns, 111 * kCanUs);
}

TEST_F(SimulatedCan, EveryOtherNodeHearsAFrame) {
  SimulatedCanBus sender(instant_);
  std::array<SimulatedCanBus, 3> others{SimulatedCanBus{instant_}, SimulatedCanBus{instant_},
                                        SimulatedCanBus{instant_}};
  ASSERT_TRUE(sender.send(can_frame(1, {1})));
  for (SimulatedCanBus& other : others) {
    EXPECT_EQ(all(other).size(), 1U);
  }
  EXPECT_TRUE(all(sender).empty());
}

TEST_F(SimulatedCan, FullSendQueueTakesWhatFitsThenRefuses) {
  SimulatedCanBus left(wire_, {.send_capacity = 4});
  SimulatedCanBus right(wire_);
  const std::vector<CanFrame> six(6, can_frame(1, {1}));
  EXPECT_EQ(left.send(six), 4U);
  EXPECT_EQ(code_of(left.send(six)), ErrorCode::queue_full);
  EXPECT_EQ(left.counters().sent, 4U);
  EXPECT_EQ(left.counters().send_refused, 8U);
  clock_.advance_by(1000 * kCanUs);
  EXPECT_EQ(left.send(six), 4U);
}

TEST_F(SimulatedCan, LowestIdentifierGoesFirst) {
  SimulatedCanBus a(wire_);
  SimulatedCanBus c(wire_);
  SimulatedCanBus b(wire_);
  SimulatedCanBus listener(wire_);
  ASSERT_TRUE(a.send(can_frame(0x700, {})));  // has the wire while the others queue
  ASSERT_TRUE(a.send(can_frame(0x300, {})));
  ASSERT_TRUE(a.send(can_frame(0x001, {})));  // must wait behind its own node's 0x300
  ASSERT_TRUE(b.send(can_frame(0x200, {})));
  CanFrame extended{.id = 0x200U << 18U, .extended = true};
  ASSERT_TRUE(c.send(extended));  // same base identifier: loses against the standard frame
  clock_.advance_by(10'000 * kCanUs);
  std::vector<std::uint32_t> order;
  for (const CanReceived& received : all(listener)) {
    order.push_back(received.frame.id);
  }
  EXPECT_EQ(order, (std::vector<std::uint32_t>{0x700, 0x200, 0x200U << 18U, 0x300, 0x001}));
}

TEST_F(SimulatedCan, FullReceiveQueueDropsWhatComesAndCountsIt) {
  SimulatedCanBus left(instant_);
  SimulatedCanBus right(instant_, {.receive_capacity = 3});
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(left.send(can_frame(1, {i})));
  }
  EXPECT_EQ(right.counters().receive_dropped, 2U);
  const auto received = all(right);
  ASSERT_EQ(received.size(), 3U);
  EXPECT_EQ(received[2].frame.data[0], std::byte{2});
}

TEST_F(SimulatedCan, ClassicNodeSendsNoFdOnAnFdNetwork) {
  SimulatedCanBus classic(instant_, {.fd = false});
  EXPECT_FALSE(classic.fd_enabled());
  EXPECT_EQ(code_of(classic.send(CanFrame{.fd = true})), ErrorCode::not_supported);
}

TEST_F(SimulatedCan, LostFramesReachNobody) {
  SimulatedCanBus left(instant_);
  SimulatedCanBus right(instant_);
  instant_.lose_next(2);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(left.send(can_frame(1, {i})));
  }
  const auto received = all(right);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received[0].frame.data[0], std::byte{2});
  EXPECT_EQ(instant_.lost(), 2U);
  EXPECT_EQ(instant_.delivered(), 1U);
}

TEST_F(SimulatedCan, BusOffIsSilentAndDeafUntilRestart) {
  SimulatedCanBus left(wire_);
  SimulatedCanBus right(wire_);
  ASSERT_TRUE(left.set_error_classes(kCanBusOff | kCanRestarted));
  ASSERT_TRUE(left.send(can_frame(1, {1})));
  left.force_bus_off();
  EXPECT_EQ(left.status().state, CanState::bus_off);
  EXPECT_EQ(left.status().transmit_errors, 255);
  EXPECT_EQ(code_of(left.send(can_frame(1, {1}))), ErrorCode::bus_off);
  ASSERT_TRUE(right.send(can_frame(2, {2})));
  clock_.advance_by(1000 * kCanUs);
  EXPECT_EQ(right.waiting_to_be_read(), 0U);
  ASSERT_TRUE(left.restart());
  EXPECT_EQ(left.status().state, CanState::error_active);
  const auto reports = all(left);
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_EQ(reports[0].kind, CanReceived::Kind::error);
  EXPECT_EQ(reports[0].error.classes, kCanBusOff);
  EXPECT_EQ(reports[1].error.classes, kCanRestarted);
  EXPECT_EQ(left.counters().error_reports, 2U);
  EXPECT_EQ(left.counters().received, 0U);
  ASSERT_TRUE(left.send(can_frame(3, {})));
  clock_.advance_by(1000 * kCanUs);
  EXPECT_EQ(all(right).size(), 1U);
}

// ISO 11898-1: a failed transmission costs 8, a good one gives 1 back; 96 warns, 128 is passive,
// 256 is off.
TEST_F(SimulatedCan, FailedTransmissionsLeadOffTheBusStepByStep) {
  SimulatedCanBus left(wire_);
  SimulatedCanBus right(wire_);
  ASSERT_TRUE(left.set_error_classes(kCanController | kCanBusOff));
  left.fail_transmissions(32);
  ASSERT_TRUE(left.send(can_frame(1, {})));
  std::map<CanState, int> failures_until;
  for (int failures = 1; failures <= 32; ++failures) {
    clock_.advance_by(47 * kCanUs);
    EXPECT_EQ(left.status().transmit_errors, std::min(8 * failures, 255));
    failures_until.try_emplace(left.status().state, failures);
  }
  EXPECT_EQ(failures_until, (std::map<CanState, int>{{CanState::error_active, 1},
                                                     {CanState::error_warning, 96 / 8},
                                                     {CanState::error_passive, 128 / 8},
                                                     {CanState::bus_off, 256 / 8}}));
  const auto reports = all(left);
  ASSERT_EQ(reports.size(), 3U);
  EXPECT_EQ(reports[0].error.controller, kCanTransmitWarning);
  EXPECT_EQ(reports[1].error.controller, kCanTransmitPassive);
  EXPECT_EQ(reports[2].error.classes, kCanBusOff);
  EXPECT_EQ(right.waiting_to_be_read(), 0U);
}

TEST_F(SimulatedCan, FailedTransmissionIsTriedAgainAndTheCounterRecovers) {
  SimulatedCanBus left(wire_);
  SimulatedCanBus right(wire_);
  left.fail_transmissions(1);
  ASSERT_TRUE(left.send(can_frame(1, {})));
  clock_.advance_by(94 * kCanUs);
  EXPECT_EQ(right.waiting_to_be_read(), 1U);
  EXPECT_EQ(left.status().transmit_errors, 7);
}

TEST_F(SimulatedCan, ErrorReportsComeOnlyIfAskedForAndPastTheFilters) {
  SimulatedCanBus node(instant_);
  node.inject_error({.classes = kCanNoAcknowledge});
  ASSERT_TRUE(node.set_filters({}));
  ASSERT_TRUE(node.set_error_classes(kCanNoAcknowledge));
  node.inject_error({.classes = kCanNoAcknowledge | kCanBusError});
  node.inject_error({.classes = kCanBusError});
  const auto reports = all(node);
  ASSERT_EQ(reports.size(), 1U);
  EXPECT_EQ(reports[0].kind, CanReceived::Kind::error);
  EXPECT_EQ(reports[0].error.classes, kCanNoAcknowledge | kCanBusError);
}

TEST_F(SimulatedCan, LinkThatGoesDownTakesItsFrameOffTheWire) {
  SimulatedCanBus left(wire_);
  SimulatedCanBus other(wire_);
  SimulatedCanBus listener(wire_);
  ASSERT_TRUE(left.send(can_frame(1, {})));
  ASSERT_TRUE(other.send(can_frame(2, {})));
  clock_.advance_by(10 * kCanUs);
  left.set_link_up(false);
  left.set_link_up(true);
  clock_.advance_by(47 * kCanUs);
  const auto received = all(listener);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received[0].frame.id, 2U);
}

TEST_F(SimulatedCan, RemovedInterfaceIsDisconnectedForGood) {
  SimulatedCanBus left(instant_);
  SimulatedCanBus right(instant_);
  ASSERT_TRUE(right.send(can_frame(1, {})));
  left.remove_interface();
  std::array<CanReceived, 1> one;
  EXPECT_EQ(left.receive(one, kNoWait), 1U);
  EXPECT_EQ(code_of(left.receive(one, kForever)), ErrorCode::disconnected);
  EXPECT_EQ(code_of(left.send(can_frame(1, {}))), ErrorCode::disconnected);
  EXPECT_EQ(code_of(left.set_filters({})), ErrorCode::disconnected);
  EXPECT_EQ(code_of(left.set_error_classes(0)), ErrorCode::disconnected);
  EXPECT_EQ(code_of(left.restart()), ErrorCode::disconnected);
  EXPECT_EQ(left.status().state, CanState::stopped);
}

// A drive that answers each request 200 us after it heard it.
class Drive final : public SimulatedEventSource {
 public:
  explicit Drive(SimulatedCanNetwork& network) : clock_(network.clock()), bus_(network) {
    clock_.attach(*this);
  }
  Drive(const Drive&) = delete;
  Drive& operator=(const Drive&) = delete;
  ~Drive() { clock_.detach(*this); }

  TimeNs next_event_ns() const override {
    return answer_ns_ != kForever          ? answer_ns_
           : bus_.waiting_to_be_read() > 0 ? clock_.now_ns()
                                           : kForever;
  }
  void run_event() override {
    if (answer_ns_ != kForever) {
      answer_ns_ = kForever;
      EXPECT_TRUE(bus_.send(can_frame(0x80, {42})));
      return;
    }
    std::array<CanReceived, 1> one;
    EXPECT_EQ(bus_.receive(one, kNoWait), 1U);
    answer_ns_ = one[0].time_ns + 200 * kCanUs;
  }

 private:
  SimulatedClock& clock_;
  SimulatedCanBus bus_;
  TimeNs answer_ns_ = kForever;
};

TEST_F(SimulatedCan, EmulatedDriveAnswersWhileTheHostWaits) {
  SimulatedCanBus host(wire_);
  Drive drive(wire_);
  std::array<CanReceived, 1> one;
  for (TimeNs tick = 0; tick < 5; ++tick) {
    clock_.sleep_until(tick * 1000 * kCanUs);
    ASSERT_TRUE(host.send(can_frame(0x40, {1})));
    ASSERT_EQ(host.receive(one, clock_.now_ns() + 500 * kCanUs), 1U);
    EXPECT_EQ(one[0].time_ns, (tick * 1000 + 55 + 200 + 55) * kCanUs);
  }
}

}  // namespace
}  // namespace tactus::hal
