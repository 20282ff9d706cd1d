#include "hal/simulated/usb_endpoint.h"

#include "tests/unit/hal/usb_endpoint_contract.h"

namespace tactus::hal {
namespace {

// The device of the contract. It echoes `delay_ns` after it got something.
class EchoPeer final : public SimulatedUsbPeer {
 public:
  explicit EchoPeer(TimeNs delay_ns) : delay_ns_(delay_ns) {}
  void connect(SimulatedUsbEndpoint& endpoint) { endpoint_ = &endpoint; }

  Result<std::size_t> control_out(const UsbSetup& setup, std::span<const std::byte>) override {
    if (setup.request != kStore.request) {
      return failure(ErrorCode::stalled);
    }
    value_ = setup.value;
    return std::size_t{0};
  }
  Result<std::size_t> control_in(const UsbSetup& setup, std::span<std::byte> buffer) override {
    if (setup.request != kFetch.request || buffer.size() < 2) {
      return failure(ErrorCode::stalled);
    }
    buffer[0] = static_cast<std::byte>(value_);
    buffer[1] = static_cast<std::byte>(value_ >> 8U);
    return std::size_t{2};
  }
  void bulk_out(std::span<const std::byte> data) override {
    heard_.insert(heard_.end(), data.begin(), data.end());
    EXPECT_TRUE(endpoint_->answer(data, delay_ns_));
  }

  const std::vector<std::byte>& heard() const { return heard_; }

 private:
  TimeNs delay_ns_;
  SimulatedUsbEndpoint* endpoint_ = nullptr;
  std::uint16_t value_ = 0;
  std::vector<std::byte> heard_;
};

template <TimeNs kDelayNs, TimeNs kDepartureNs>
struct SimulatedUsbRig {
  SimulatedUsbRig() { peer.connect(simulated_endpoint); }
  UsbEndpoint& endpoint() { return simulated_endpoint; }
  Clock& clock() { return simulated; }
  void unplug() { simulated_endpoint.unplug(kDepartureNs); }
  void plug_in() { simulated_endpoint.plug_in(); }
  void set_stopped(bool stopped) { simulated_endpoint.set_stopped(stopped); }

  SimulatedClock simulated;
  EchoPeer peer{kDelayNs};
  SimulatedUsbEndpoint simulated_endpoint{simulated, peer, {.out_time_ns = kDelayNs}};
};

using UsbRigs = ::testing::Types<SimulatedUsbRig<0, 0>, SimulatedUsbRig<200'000, 5'000'000>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, UsbEndpointContract, UsbRigs);

constexpr TimeNs kUsbUs = 1000;

class SimulatedUsb : public ::testing::Test {
 protected:
  SimulatedUsb() { peer_.connect(endpoint_); }

  template <class T>
  void expect_refused(const Result<T>& result, ErrorCode code) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
  }

  SimulatedClock clock_{0};
  EchoPeer peer_{300 * kUsbUs};
  SimulatedUsbEndpoint endpoint_{
      clock_, peer_, {.max_packet_bytes = 8, .out_time_ns = 100 * kUsbUs}};
  std::array<std::byte, 64> buffer_{};
  std::array<std::byte, 20> data_{};
};

TEST_F(SimulatedUsb, ExchangeTakesTheTimeOfTheWayOutAndOfTheAnswer) {
  ASSERT_EQ(endpoint_.bulk_out(data_, 1000 * kUsbUs), data_.size());
  EXPECT_EQ(clock_.now_ns(), 100 * kUsbUs);
  ASSERT_EQ(endpoint_.bulk_in(buffer_, 1000 * kUsbUs), data_.size());
  EXPECT_EQ(clock_.now_ns(), 400 * kUsbUs);
}

TEST_F(SimulatedUsb, ReadStopsExactlyAtItsDeadline) {
  ASSERT_TRUE(endpoint_.answer(data_, 300 * kUsbUs));
  expect_refused(endpoint_.bulk_in(buffer_, 299 * kUsbUs), ErrorCode::timeout);
  EXPECT_EQ(clock_.now_ns(), 299 * kUsbUs);
  EXPECT_EQ(endpoint_.bulk_in(buffer_, 300 * kUsbUs), data_.size());
}

TEST_F(SimulatedUsb, AnswerCanComeWithinTheWait) {
  UsbTransfer read = UsbTransfer::in(buffer_);
  UsbTransfer write = UsbTransfer::out(data_);
  ASSERT_TRUE(endpoint_.submit(read));
  ASSERT_TRUE(endpoint_.submit(write));
  EXPECT_EQ(endpoint_.wait(read, 1000 * kUsbUs), data_.size());
  EXPECT_EQ(clock_.now_ns(), 400 * kUsbUs);
  EXPECT_EQ(write.result(), data_.size());
}

TEST_F(SimulatedUsb, WholePacketsEndAReadOnlyWhenItIsFull) {
  ASSERT_TRUE(endpoint_.answer(std::span(data_).first(16)));
  EXPECT_EQ(endpoint_.bulk_in(std::span(buffer_).first(16), kNoWait), 16U);
  ASSERT_TRUE(endpoint_.answer(std::span(data_).first(16)));
  ASSERT_TRUE(endpoint_.answer({}));
  UsbTransfer read = UsbTransfer::in(buffer_);
  ASSERT_TRUE(endpoint_.submit(read));
  EXPECT_EQ(read.result(), 16U);
}

TEST_F(SimulatedUsb, OverflowLosesThePacketAndNothingElse) {
  ASSERT_TRUE(endpoint_.answer(std::span(data_).first(5)));
  ASSERT_TRUE(endpoint_.answer(std::span(data_).first(3)));
  expect_refused(endpoint_.bulk_in(std::span(buffer_).first(4), kNoWait), ErrorCode::overflow);
  EXPECT_EQ(endpoint_.bulk_in(buffer_, kNoWait), 3U);
}

TEST_F(SimulatedUsb, DeviceThatTakesOnlyPartGivesAShortWrite) {
  endpoint_.take_only(16);
  EXPECT_EQ(endpoint_.bulk_out(data_, 1000 * kUsbUs), 16U);
  expect_refused(endpoint_.bulk_out(data_, 2000 * kUsbUs), ErrorCode::timeout);
  endpoint_.take_only(SimulatedUsbEndpoint::kTakeAll);
  EXPECT_EQ(endpoint_.bulk_out(data_, 3000 * kUsbUs), data_.size());
  EXPECT_EQ(peer_.heard().size(), 36U);
}

TEST_F(SimulatedUsb, HaltedEndpointStalls) {
  UsbTransfer read = UsbTransfer::in(buffer_);
  ASSERT_TRUE(endpoint_.submit(read));
  endpoint_.set_halted(true);
  expect_refused(read.result(), ErrorCode::stalled);
  expect_refused(endpoint_.bulk_out(data_, 1000 * kUsbUs), ErrorCode::stalled);
  endpoint_.set_halted(false);
  EXPECT_TRUE(endpoint_.bulk_out(data_, 1000 * kUsbUs));
}

TEST_F(SimulatedUsb, InjectedFailuresComeAndGo) {
  endpoint_.fail_next(2, ErrorCode::io);
  expect_refused(endpoint_.bulk_out(data_, 1000 * kUsbUs), ErrorCode::io);
  expect_refused(endpoint_.bulk_in(buffer_, 1000 * kUsbUs), ErrorCode::io);
  EXPECT_TRUE(endpoint_.bulk_out(data_, 1000 * kUsbUs));
}

TEST_F(SimulatedUsb, UnplugLooksAsOnLinuxFirstIoThenDisconnected) {
  UsbTransfer read = UsbTransfer::in(buffer_);
  ASSERT_TRUE(endpoint_.submit(read));
  endpoint_.unplug(3000 * kUsbUs);
  expect_refused(read.result(), ErrorCode::io);
  EXPECT_EQ(endpoint_.state(), UsbState::attached);
  expect_refused(endpoint_.bulk_in(buffer_, 1000 * kUsbUs), ErrorCode::io);
  EXPECT_FALSE(endpoint_.answer(data_));
  clock_.advance_to(3000 * kUsbUs);
  EXPECT_EQ(endpoint_.state(), UsbState::detached);
  expect_refused(endpoint_.bulk_in(buffer_, 9000 * kUsbUs), ErrorCode::disconnected);
}

TEST_F(SimulatedUsb, WhatTheDeviceHadToSayIsLostWithIt) {
  ASSERT_TRUE(endpoint_.answer(data_));
  endpoint_.unplug();
  endpoint_.plug_in();
  ASSERT_TRUE(endpoint_.reopen());
  expect_refused(endpoint_.bulk_in(buffer_, kNoWait), ErrorCode::timeout);
}

TEST_F(SimulatedUsb, ControlToAStoppedDeviceWaitsForTheDeadline) {
  endpoint_.set_stopped(true);
  expect_refused(endpoint_.control_out(kStore, {}, 50 * kUsbUs), ErrorCode::timeout);
  EXPECT_EQ(clock_.now_ns(), 50 * kUsbUs);
}

TEST_F(SimulatedUsb, LateAnswerIsNotOvertaken) {
  ASSERT_TRUE(endpoint_.answer(std::span(data_).first(5), 300 * kUsbUs));
  ASSERT_TRUE(endpoint_.answer(std::span(data_).first(3)));
  expect_refused(endpoint_.bulk_in(buffer_, 200 * kUsbUs), ErrorCode::timeout);
  EXPECT_EQ(endpoint_.bulk_in(buffer_, 300 * kUsbUs), 5U);
  EXPECT_EQ(endpoint_.bulk_in(buffer_, kNoWait), 3U);
}

TEST_F(SimulatedUsb, AnswerWithoutRoomIsRefusedWhole) {
  const std::vector<std::byte> almost_all(8 * (SimulatedUsbEndpoint::kMaxPackets - 1));
  ASSERT_TRUE(endpoint_.answer(almost_all));
  EXPECT_FALSE(endpoint_.answer(std::span(data_).first(9)));
  EXPECT_TRUE(endpoint_.answer(std::span(data_).first(8)));
}

}  // namespace
}  // namespace tactus::hal
