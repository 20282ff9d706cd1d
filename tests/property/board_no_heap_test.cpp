// The boards' drivers never touch the heap: not in a tick, not when they come up, not when they
// fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "drivers/falcon_usb/falcon.h"
#include "drivers/haply_serial/haply.h"
#include "hal/simulated/serial_port.h"
#include "hal/simulated/usb_endpoint.h"
#include "tests/support/heap_trap.h"

namespace tactus::testing {
namespace {

constexpr hal::TimeNs kBoardTick_ns = 1'000'000;

// A homed Falcon that stands still.
class StillFalcon final : public hal::SimulatedUsbPeer {
 public:
  void connect(hal::SimulatedUsbEndpoint& endpoint) { endpoint_ = &endpoint; }

 private:
  hal::Result<std::size_t> control_out(const hal::UsbSetup&, std::span<const std::byte>) override {
    return std::size_t{0};
  }
  hal::Result<std::size_t> control_in(const hal::UsbSetup&, std::span<std::byte>) override {
    return hal::failure(hal::ErrorCode::stalled);
  }
  void bulk_out(std::span<const std::byte> data) override {
    if (data.size() == drivers::kFalconPacketBytes) {
      std::array<std::byte, 2 + drivers::kFalconPacketBytes> answer{};
      const drivers::FalconPacket packet = drivers::encode({});
      std::ranges::copy(packet, answer.begin() + 2);
      answer[2 + 13] = std::byte{'A' + 0x70};
      endpoint_->answer(answer, 100'000);
    }
  }

  hal::SimulatedUsbEndpoint* endpoint_ = nullptr;
};

template <class Board, std::size_t kAxes>
void tick(Board& board, hal::SimulatedClock& clock,
          std::array<drivers::AxisSample, kAxes>& samples) {
  const std::array<drivers::AxisCommand, kAxes> commands{};
  board.read(samples, clock.now_ns() + kBoardTick_ns / 2);
  board.write(commands);
  clock.advance_by(kBoardTick_ns / 2);
}

TEST(NoHeapBoards, FalconComesUpTicksAndFailsWithoutTheHeap) {
  hal::SimulatedClock clock;
  StillFalcon device;
  hal::SimulatedUsbEndpoint endpoint(clock, device);
  device.connect(endpoint);
  drivers::Falcon driver(endpoint, clock, {.unproven_watchdog = true});
  std::array<drivers::AxisSample, 3> samples{};
  const HeapTrap trap;
  driver.start();
  for (int i = 0; i < 500; ++i) {
    tick(driver, clock, samples);
  }
  EXPECT_EQ(samples[0].status, drivers::kDeviceOk);
  endpoint.unplug(3'000'000);
  for (int i = 0; i < 10; ++i) {
    tick(driver, clock, samples);
  }
  EXPECT_NE(samples[0].status & drivers::kDeviceLost, 0U);
  driver.stop();
  EXPECT_EQ(trap.calls(), 0U);
}

constexpr std::size_t kSetupBytes = 26;  // of two axes

TEST(NoHeapBoards, HaplyComesUpTicksAndFailsWithoutTheHeap) {
  hal::SimulatedClock clock;
  hal::SimulatedSerialPort host(clock);
  hal::SimulatedSerialPort board(clock);
  host.connect(board);
  drivers::HaplyConfig config;
  config.unproven_watchdog = true;
  drivers::Haply driver(host, clock, config);
  std::array<drivers::AxisSample, drivers::kHaplyMaxAxes> samples{};
  std::array<std::byte, 9> answer = {std::byte{5}};
  std::array<std::byte, 256> heard{};
  const HeapTrap trap;
  driver.start();
  for (int i = 0; i < 500; ++i) {
    tick(driver, clock, samples);
    const auto got = board.read(heard, hal::kNoWait);
    if (got && heard[0] == std::byte{2} && *got == 10) {
      (void)board.write(answer, hal::kNoWait);
    } else if (got && *got >= kSetupBytes) {  // the angles that it is to count from
      std::copy_n(heard.data() + *got - 16, 4, answer.data() + 1);
      std::copy_n(heard.data() + *got - 8, 4, answer.data() + 5);
    }
  }
  EXPECT_EQ(samples[0].status, drivers::kDeviceOk);
  host.unplug();
  for (int i = 0; i < 10; ++i) {
    tick(driver, clock, samples);
  }
  EXPECT_NE(samples[0].status & drivers::kDeviceLost, 0U);
  driver.stop();
  EXPECT_EQ(trap.calls(), 0U);
}

}  // namespace
}  // namespace tactus::testing
