#include "hal/simulated/serial_port.h"

#include "tests/unit/hal/serial_port_contract.h"

namespace tactus::hal {
namespace {

template <TimeNs kByteTimeNs, TimeNs kLatencyNs>
struct SimulatedSerialRig {
  SimulatedSerialRig() { host.connect(device); }
  SerialPort& port() { return host; }
  Clock& clock() { return simulated; }
  void answer(std::span<const std::byte> bytes) {
    EXPECT_EQ(device.write(bytes, kForever), bytes.size());
  }
  std::size_t hear(std::span<std::byte> buffer) {
    return device.read(buffer, kNoWait).value_or(0U);
  }
  void unplug() { host.unplug(); }
  void plug_in() { host.plug_in(); }

  static constexpr SimulatedSerialConfig kLine{.byte_time_ns = kByteTimeNs,
                                               .latency_ns = kLatencyNs};
  SimulatedClock simulated;
  SimulatedSerialPort host{simulated, kLine};
  SimulatedSerialPort device{simulated, kLine};
};

using SerialRigs =
    ::testing::Types<SimulatedSerialRig<0, 0>, SimulatedSerialRig<86'806, 1'000'000>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, SerialPortContract, SerialRigs);

class SimulatedSerial : public ::testing::Test {
 protected:
  SimulatedSerial() { host_.connect(device_); }

  SimulatedClock clock_{0};
  SimulatedSerialPort host_{clock_, {.byte_time_ns = 1000, .latency_ns = 500}};
  SimulatedSerialPort device_{clock_};
  std::array<std::byte, 10> data_{};
  std::array<std::byte, 16> buffer_{};
};

TEST_F(SimulatedSerial, BytesArriveOneAfterTheOther) {
  ASSERT_EQ(host_.write(data_, kNoWait), 10U);
  ASSERT_EQ(device_.read(buffer_, kForever), 1U);
  EXPECT_EQ(clock_.now_ns(), 1500);
  ASSERT_EQ(device_.read_all(std::span(buffer_).first(9), kForever), 9U);
  EXPECT_EQ(clock_.now_ns(), 10'500);
}

TEST_F(SimulatedSerial, DeviceThatTakesOnlyPartGivesAShortWrite) {
  host_.take_only(4);
  EXPECT_EQ(host_.write(data_, 50'000), 4U);
  EXPECT_EQ(clock_.now_ns(), 50'000);
  const auto refused = host_.write(data_, 60'000);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::timeout);
  host_.take_only(SimulatedSerialPort::kTakeAll);
  EXPECT_EQ(host_.write(data_, 60'000), 10U);
}

TEST_F(SimulatedSerial, InjectedFailuresComeAndGo) {
  host_.fail_next(2, ErrorCode::io);
  EXPECT_EQ(host_.write(data_, kNoWait).error().code, ErrorCode::io);
  EXPECT_EQ(host_.read(buffer_, kNoWait).error().code, ErrorCode::io);
  EXPECT_EQ(host_.write(data_, kNoWait), 10U);
}

TEST_F(SimulatedSerial, WhatWasOnTheLineIsLostWithTheDevice) {
  ASSERT_EQ(device_.write(data_, kNoWait), 10U);
  host_.unplug();
  host_.plug_in();
  ASSERT_TRUE(host_.reopen());
  const auto read = host_.read(buffer_, 1'000'000);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::timeout);
}

}  // namespace
}  // namespace tactus::hal
